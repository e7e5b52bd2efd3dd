// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace cairn {

/// Beginning of every binary file of a map: eight letters and the version of the layout.
struct BinaryKind {
  std::string_view magic;  ///< 8 bytes
  std::uint32_t version = 0;
};

/// What to do about a map that cannot be read.
constexpr std::string_view kMapRemedy = "Copy the map again from where it was made, or make it again.";

/// A binary file in memory: magic, version, little-endian values without padding, and their CRC-32.
class BinaryWriter {
 public:
  explicit BinaryWriter(const BinaryKind& kind);

  template <class Value>
  void put(Value value) {
    static_assert(std::is_arithmetic_v<Value>);
    static_assert(std::endian::native == std::endian::little, "the files are little-endian");
    put_bytes(&value, sizeof(Value));
  }
  void put_bytes(const void* bytes, std::size_t count) {
    contents_.append(static_cast<const char*>(bytes), count);
  }
  /// The whole file, with the CRC-32 of all before it as its last four bytes.
  [[nodiscard]] std::string finish() &&;

 private:
  std::string contents_;
};

/// The CRC-32 that a file made by BinaryWriter ends with.
[[nodiscard]] std::uint32_t stored_checksum(std::string_view file);

/// Reads what BinaryWriter made, in the same order. Magic, version and CRC-32 are checked before anything is
/// handed out. InputError names the file.
class BinaryReader {
 public:
  BinaryReader(const std::filesystem::path& path, const BinaryKind& kind);

  template <class Value>
  [[nodiscard]] Value get() {
    static_assert(std::is_arithmetic_v<Value>);
    Value value;
    std::memcpy(&value, get_bytes(sizeof(Value)), sizeof(Value));
    return value;
  }
  /// Valid as long as the reader.
  [[nodiscard]] const char* get_bytes(std::size_t count);
  /// InputError unless what is left are `count` records of `bytes` bytes (at least 1, at most 2^33), then
  /// `more_count` of `more_bytes`: ask before making room for them.
  void expect_bytes(std::uint64_t count, std::uint64_t bytes, std::uint64_t more_count = 0,
                    std::uint64_t more_bytes = 1) const;
  /// InputError unless the file ends with this checksum: it is another file's.
  void expect_checksum(std::optional<std::uint32_t> checksum) const;
  [[noreturn]] void fail(std::string expected, std::string found) const;

 private:
  [[nodiscard]] std::size_t left() const;

  std::filesystem::path path_;
  std::string contents_;
  std::size_t next_ = 0;
};

}  // namespace cairn
