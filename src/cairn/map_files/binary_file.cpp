// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/binary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr std::size_t kChecksumBytes = sizeof(std::uint32_t);
constexpr std::size_t kBlocksAtOnce = 64;

}  // namespace

void BlockSeal::close_block() {
  const std::uint32_t checksum = block_.value();
  checksums_.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  block_ = {};
  in_block_ = 0;
}

void BlockSeal::add(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view piece = bytes.substr(0, kBlockBytes - in_block_);
    block_.add(piece);
    in_block_ += piece.size();
    bytes.remove_prefix(piece.size());
    if (in_block_ == kBlockBytes) close_block();
  }
}

std::string BlockSeal::finish() && {
  if (in_block_ > 0) close_block();
  const std::uint32_t of_all = crc32(checksums_);
  checksums_.append(reinterpret_cast<const char*>(&of_all), sizeof of_all);
  return std::move(checksums_);
}

std::optional<std::uint64_t> sealed_bytes(std::uint64_t file_bytes) {
  if (file_bytes < kChecksumBytes) return {};
  const std::uint64_t rest = file_bytes - kChecksumBytes;
  const std::uint64_t blocks = (rest + kBlockBytes + kChecksumBytes - 1) / (kBlockBytes + kChecksumBytes);
  const std::uint64_t body = rest - std::min(rest, blocks * kChecksumBytes);
  if ((body + kBlockBytes - 1) / kBlockBytes != blocks) return {};
  return body;
}

BinaryWriter::BinaryWriter(const BinaryKind& kind) {
  require(kind.magic.size() == 8, "a binary file begins with eight letters");
  put_bytes(kind.magic.data(), kind.magic.size());
  put(kind.version);
}

std::string BinaryWriter::finish() && {
  BlockSeal seal;
  seal.add(bytes_);
  bytes_ += std::move(seal).finish();
  return std::move(bytes_);
}

BinaryFileWriter::BinaryFileWriter(const std::filesystem::path& path, const BinaryWriter& begin)
    : file_(path) {
  write(begin.bytes());
}

void BinaryFileWriter::write(std::string_view bytes) {
  seal_.add(bytes);
  file_.write(bytes);
}

std::uint32_t BinaryFileWriter::finish() {
  const std::string end = std::move(seal_).finish();
  file_.write(end);
  file_.commit();
  return stored_checksum(end);
}

std::uint32_t stored_checksum(std::string_view file) {
  require(file.size() >= kChecksumBytes, "the file has a checksum");
  std::uint32_t checksum = 0;
  std::memcpy(&checksum, file.data() + file.size() - kChecksumBytes, kChecksumBytes);
  return checksum;
}

BinaryReader::BinaryReader(const std::filesystem::path& path, const BinaryKind& kind)
    : path_(path), file_(path) {
  check_beginning(kind);
  read_seal();
  file_.seek(0);
  (void)get_bytes(kind.magic.size() + sizeof(kind.version));
}

/// Checks magic and version before any checksum: in a file of another kind or version nothing else can be
/// checked.
void BinaryReader::check_beginning(const BinaryKind& kind) {
  const std::size_t bytes = kind.magic.size() + sizeof(kind.version), least = bytes + kChecksumBytes;
  if (file_.size() < least) fail(fmt::format("at least {} bytes", least), fmt::format("{}", file_.size()));
  std::string begin(bytes, '\0');
  read_bytes(begin.data(), bytes);
  if (!begin.starts_with(kind.magic))
    fail(fmt::format("a file that begins with {}", kind.magic), "another beginning");
  std::uint32_t version = 0;
  std::memcpy(&version, begin.data() + kind.magic.size(), sizeof version);
  if (version != kind.version)
    throw InputError({path_.string(), 0, fmt::format("version {} of the format", kind.version),
                      fmt::format("version {}", version), std::string(kVersionRemedy)});
}

void BinaryReader::read_seal() {
  const auto body = sealed_bytes(file_.size());
  if (!body) fail_damaged();
  end_ = *body;
  seal_.resize(file_.size() - end_);
  file_.seek(end_);
  read_bytes(seal_.data(), seal_.size());
  if (crc32(std::string_view(seal_).substr(0, seal_.size() - kChecksumBytes)) != stored_checksum(seal_))
    fail_damaged();
}

void BinaryReader::read_bytes(char* bytes, std::size_t count) {
  if (file_.read(bytes, count) != count) fail_damaged();
}

void BinaryReader::check_more(std::size_t count) {
  if (count > left()) fail(fmt::format("{} bytes more", count), fmt::format("{}", left()));
  checked_.erase(0, next_);
  next_ = 0;
  while (checked_.size() < count) {
    const std::size_t known = checked_.size();
    const auto more =
        static_cast<std::size_t>(std::min<std::uint64_t>(end_ - read_, kBlocksAtOnce * kBlockBytes));
    checked_.resize(known + more);
    read_bytes(checked_.data() + known, more);
    check_blocks(std::string_view(checked_).substr(known), read_ / kBlockBytes);
    read_ += more;
  }
}

void BinaryReader::check_blocks(std::string_view bytes, std::uint64_t first_block) const {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBlockBytes) {
    std::uint32_t expected = 0;
    const std::uint64_t block = first_block + begin / kBlockBytes;
    std::memcpy(&expected, seal_.data() + block * kChecksumBytes, kChecksumBytes);
    if (crc32(bytes.substr(begin, kBlockBytes)) != expected) fail_damaged();
  }
}

void BinaryReader::expect_checksum(std::optional<std::uint32_t> checksum) const {
  if (checksum != stored_checksum(seal_)) fail("the file that map.json names, by its CRC-32", "another");
}

void BinaryReader::expect_bytes(std::uint64_t count, std::uint64_t bytes, std::uint64_t more_count,
                                std::uint64_t more_bytes) const {
  const std::uint64_t room = left();
  const bool fits = count <= room / bytes && more_count <= room / more_bytes &&  // so nothing overflows
                    count * bytes + more_count * more_bytes == room;
  if (!fits)
    fail(fmt::format("{} records of {} bytes{}", count, bytes,
                     more_count == 0 ? "" : fmt::format(" and {} of {}", more_count, more_bytes)),
         fmt::format("{} bytes", room));
}

void BinaryReader::fail_damaged() const {
  fail("contents that fit their CRC-32", "others: the file is damaged or cut short");
}

void BinaryReader::fail(std::string expected, std::string found) const {
  throw InputError({path_.string(), 0, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

}  // namespace cairn
