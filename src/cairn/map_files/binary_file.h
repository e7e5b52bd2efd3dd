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

#include "cairn/core/checksum.h"
#include "cairn/core/file.h"

namespace cairn {

/// Beginning of every binary file of a map: eight letters and the version of the layout.
struct BinaryKind {
  std::string_view magic;  ///< 8 bytes
  std::uint32_t version = 0;
};

/// What to do about a map that cannot be read.
constexpr std::string_view kMapRemedy = "Copy the map again from where it was made, or make it again.";

/// Remedy for a map of a version that this program does not read.
constexpr std::string_view kVersionRemedy =
    "Make the map again, or read it with the version of cairn that made it.";

/// Bytes of a binary file that one checksum covers, so that little has to be read to check a component.
constexpr std::size_t kBlockBytes = 4096;

/// The end of a binary file: CRC-32 of each block of kBlockBytes, of which the last may be shorter, and the
/// CRC-32 of these checksums.
class BlockSeal {
 public:
  /// The next bytes of the file, in pieces of any size.
  void add(std::string_view bytes);
  /// What has to follow them.
  [[nodiscard]] std::string finish() &&;

 private:
  void close_block();

  std::string checksums_;
  Crc32 block_;
  std::size_t in_block_ = 0;
};

/// How many bytes of a binary file come before its seal; nothing where no file has this size.
[[nodiscard]] std::optional<std::uint64_t> sealed_bytes(std::uint64_t file_bytes);

/// Little-endian values without padding.
class ByteWriter {
 public:
  template <class Value>
  void put(Value value) {
    static_assert(std::is_arithmetic_v<Value>);
    static_assert(std::endian::native == std::endian::little, "the files are little-endian");
    put_bytes(&value, sizeof(Value));
  }
  void put_bytes(const void* bytes, std::size_t count) {
    bytes_.append(static_cast<const char*>(bytes), count);
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 protected:
  std::string bytes_;  // NOLINT(cppcoreguidelines-non-private-member-variables-in-classes)
};

/// A binary file in memory: magic, version, values, and the seal.
class BinaryWriter : public ByteWriter {
 public:
  explicit BinaryWriter(const BinaryKind& kind);
  /// The whole file.
  [[nodiscard]] std::string finish() &&;
};

/// The same for a file that does not fit into memory: it appears under its name when it is finished.
class BinaryFileWriter {
 public:
  /// `begin` has magic, version and the first values.
  BinaryFileWriter(const std::filesystem::path& path, const BinaryWriter& begin);
  void write(std::string_view bytes);
  /// Returns the checksum that the file ends with.
  std::uint32_t finish();

 private:
  AtomicFile file_;
  BlockSeal seal_;
};

/// The checksum that a sealed file ends with.
[[nodiscard]] std::uint32_t stored_checksum(std::string_view file);

/// Reads what BinaryWriter made, in the same order, with memory for some blocks and the seal only. Magic,
/// version and the seal are checked first, and each block before anything of it is handed out. InputError
/// names the file.
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
  /// Valid until the next call.
  [[nodiscard]] const char* get_bytes(std::size_t count) {
    if (count > checked_.size() - next_) check_more(count);
    next_ += count;
    return checked_.data() + next_ - count;
  }
  /// InputError unless what is left are `count` records of `bytes` bytes (at least 1, at most 2^33), then
  /// `more_count` of `more_bytes`: ask before making room for them.
  void expect_bytes(std::uint64_t count, std::uint64_t bytes, std::uint64_t more_count = 0,
                    std::uint64_t more_bytes = 1) const;
  /// InputError unless the file ends with this checksum: it is another file's.
  void expect_checksum(std::optional<std::uint32_t> checksum) const;
  [[noreturn]] void fail(std::string expected, std::string found) const;

 private:
  void check_beginning(const BinaryKind& kind);
  void read_seal();
  /// Makes `count` bytes ready to be handed out.
  void check_more(std::size_t count);
  void check_blocks(std::string_view bytes, std::uint64_t first_block) const;
  [[noreturn]] void fail_damaged() const;
  [[nodiscard]] std::uint64_t left() const { return end_ - read_ + checked_.size() - next_; }
  void read_bytes(char* bytes, std::size_t count);

  std::filesystem::path path_;
  FileReader file_;
  std::string seal_;
  std::string checked_;               // bytes of blocks that were found good; before next_: handed out
  std::size_t next_ = 0;              // in checked_
  std::uint64_t read_ = 0, end_ = 0;  // bytes of the file until the end of checked_, and until the seal
};

}  // namespace cairn
