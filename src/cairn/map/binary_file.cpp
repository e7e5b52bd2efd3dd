// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/binary_file.h"

#include <fmt/format.h>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {
namespace {

constexpr std::size_t kChecksumBytes = sizeof(std::uint32_t);

}  // namespace

BinaryWriter::BinaryWriter(const BinaryKind& kind) : contents_(kind.magic) {
  require(kind.magic.size() == 8, "a binary file begins with eight letters");
  put(kind.version);
}

std::string BinaryWriter::finish() && {
  put(crc32(contents_));
  return std::move(contents_);
}

std::uint32_t stored_checksum(std::string_view file) {
  require(file.size() >= kChecksumBytes, "the file has a checksum");
  std::uint32_t checksum = 0;
  std::memcpy(&checksum, file.data() + file.size() - kChecksumBytes, kChecksumBytes);
  return checksum;
}

BinaryReader::BinaryReader(const std::filesystem::path& path, const BinaryKind& kind)
    : path_(path), contents_(read_file(path)) {
  const std::size_t least = kind.magic.size() + sizeof(kind.version) + kChecksumBytes;
  if (contents_.size() < least)
    fail(fmt::format("at least {} bytes", least), fmt::format("{}", contents_.size()));
  if (!contents_.starts_with(kind.magic))
    fail(fmt::format("a file that begins with {}", kind.magic), "another beginning");
  next_ = kind.magic.size();
  if (const auto version = get<std::uint32_t>(); version != kind.version)
    fail(fmt::format("version {} of the format", kind.version), fmt::format("version {}", version));
  const std::string_view body = std::string_view(contents_).substr(0, contents_.size() - kChecksumBytes);
  if (crc32(body) != stored_checksum(contents_))
    fail("contents that fit their CRC-32", "others: the file is damaged or cut short");
}

std::size_t BinaryReader::left() const {
  return contents_.size() - kChecksumBytes - next_;
}

const char* BinaryReader::get_bytes(std::size_t count) {
  if (count > left()) fail(fmt::format("{} bytes more", count), fmt::format("{}", left()));
  const char* bytes = contents_.data() + next_;
  next_ += count;
  return bytes;
}

void BinaryReader::expect_checksum(std::optional<std::uint32_t> checksum) const {
  if (checksum != stored_checksum(contents_)) fail("the file that map.json names, by its CRC-32", "another");
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

void BinaryReader::fail(std::string expected, std::string found) const {
  throw InputError({path_.string(), 0, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

}  // namespace cairn
