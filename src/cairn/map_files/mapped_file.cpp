// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr std::uint64_t kChecksumBytes = sizeof(std::uint32_t);
constexpr const char* kDamaged = "others: the file is damaged or cut short";

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path, const BinaryKind& kind,
                       std::optional<std::uint32_t> checksum)
    : path_(path) {
  map_contents();
  try {
    check_seal(kind, checksum);
  } catch (...) {
    ::munmap(const_cast<char*>(contents_), file_bytes_);
    throw;
  }
}

MappedFile::~MappedFile() {
  ::munmap(const_cast<char*>(contents_), file_bytes_);
}

void MappedFile::fail(std::string expected, std::string found) const {
  throw InputError({path_.string(), 0, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

void MappedFile::map_contents() {
  const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat status {};
  void* mapped = MAP_FAILED;
  if (file >= 0 && ::fstat(file, &status) == 0) {
    file_bytes_ = static_cast<std::uint64_t>(status.st_size);
    mapped = file_bytes_ > 0 ? ::mmap(nullptr, file_bytes_, PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
  }
  const int error_number = errno;
  if (file >= 0) ::close(file);
  if (mapped == MAP_FAILED)
    throw InputError({path_.string(), 0, "a readable file",
                      file >= 0 && file_bytes_ == 0 ? "an empty one" : std::strerror(error_number),
                      std::string(kMapRemedy)});
  contents_ = static_cast<const char*>(mapped);
}

void MappedFile::check_seal(const BinaryKind& kind, std::optional<std::uint32_t> checksum) {
  const std::uint64_t begin_bytes = kind.magic.size() + sizeof kind.version;
  const auto size = sealed_bytes(file_bytes_);
  if (!size || *size < begin_bytes) fail("contents that fit their CRC-32", kDamaged);
  if (std::string_view(contents_, kind.magic.size()) != kind.magic)
    fail(fmt::format("a file that begins with {}", kind.magic), "another beginning");
  std::uint32_t version = 0;
  std::memcpy(&version, contents_ + kind.magic.size(), sizeof version);
  if (version != kind.version)
    throw InputError({path_.string(), 0, fmt::format("version {} of the format", kind.version),
                      fmt::format("version {}", version), std::string(kVersionRemedy)});
  const std::string_view seal(contents_ + *size, file_bytes_ - *size);
  if (stored_checksum(seal) != crc32(seal.substr(0, seal.size() - kChecksumBytes)))
    fail("contents that fit their CRC-32", kDamaged);
  if (checksum != stored_checksum(seal)) fail("the file that map.json names, by its CRC-32", "another");
  size_ = *size;
  checked_ = std::make_unique<std::atomic<bool>[]>((size_ + kBlockBytes - 1) / kBlockBytes);
}

const char* MappedFile::bytes(std::uint64_t offset, std::uint64_t count) const {
  if (offset > size_ || count > size_ - offset)
    fail(fmt::format("{} bytes from {} on", count, offset), fmt::format("{} bytes", size_));
  if (count > 0)
    for (std::uint64_t block = offset / kBlockBytes; block <= (offset + count - 1) / kBlockBytes; ++block)
      if (!checked_[block].load(std::memory_order_relaxed)) check_block(block);
  return contents_ + offset;
}

std::uint64_t MappedFile::touched_bytes() const {
  std::uint64_t bytes = 0;
  for (std::uint64_t block = 0; block * kBlockBytes < size_; ++block)
    if (checked_[block].load(std::memory_order_relaxed))
      bytes += std::min<std::uint64_t>(kBlockBytes, size_ - block * kBlockBytes);
  return bytes;
}

void MappedFile::forget() const {
  ::madvise(const_cast<char*>(contents_), file_bytes_, MADV_DONTNEED);
}

void MappedFile::fetch(std::uint64_t offset, std::uint64_t count) const {
  constexpr std::uint64_t kLineBytes = 64;  // of a cache
  const std::uint64_t end = std::min(size_, offset + count);
  for (std::uint64_t place = offset; place < end; place += kLineBytes) __builtin_prefetch(contents_ + place);
}

void MappedFile::check_block(std::uint64_t block) const {
  const std::uint64_t begin = block * kBlockBytes;
  std::uint32_t expected = 0;
  std::memcpy(&expected, contents_ + size_ + block * kChecksumBytes, sizeof expected);
  if (crc32({contents_ + begin, std::min<std::uint64_t>(kBlockBytes, size_ - begin)}) != expected)
    fail("contents that fit their CRC-32", kDamaged);
  checked_[block].store(true, std::memory_order_relaxed);
}

void check_sealed_file(const std::filesystem::path& path, const BinaryKind& kind,
                       std::optional<std::uint32_t> checksum) {
  const MappedFile file(path, kind, checksum);
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::ifstream stream(path, std::ios::binary);
  std::string piece(kPiece, '\0');
  BlockSeal seal;
  for (std::uint64_t left = file.size(); left > 0;) {
    stream.read(piece.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(kPiece, left)));
    if (stream.gcount() <= 0) break;
    seal.add({piece.data(), static_cast<std::size_t>(stream.gcount())});
    left -= static_cast<std::uint64_t>(stream.gcount());
  }
  if (stored_checksum(std::move(seal).finish()) != checksum)
    file.fail("contents that fit their CRC-32", "others: the file is damaged or cut short");
}

}  // namespace cairn
