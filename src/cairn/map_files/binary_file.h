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

/// Describes how a binary file of a map begins: with eight letters and the version of the layout.
struct BinaryKind {
  std::string_view magic;  ///< 8 bytes
  std::uint32_t version = 0;
};

/// Remedy for a map that cannot be read.
constexpr std::string_view kMapRemedy = "Copy the map again from where it was made, or make it again.";

/// Remedy for a map of a version that this program does not read.
constexpr std::string_view kVersionRemedy =
    "Make the map again, or read it with the version of cairn that made it.";

/// Bytes of a binary file that one checksum covers, so that little has to be read to check a piece of it.
constexpr std::size_t kBlockBytes = 4096;

/// Computes the seal, with which a binary file ends: the CRC-32 of each block of kBlockBytes, of which the
/// last may be shorter, and the CRC-32 of these checksums.
class BlockSeal {
 public:
  /// Adds the next bytes of the file, in pieces of any size.
  void add(std::string_view bytes);
  /// Returns the seal, to be written after the bytes added.
  [[nodiscard]] std::string finish() &&;

 private:
  void close_block();

  std::string checksums_;
  Crc32 block_;
  std::size_t in_block_ = 0;
};

/// Returns how many bytes of a binary file come before its seal, or nullopt if no sealed file has this size.
[[nodiscard]] std::optional<std::uint64_t> sealed_bytes(std::uint64_t file_bytes);

/// Collects values in little-endian order without padding.
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

/// Makes a binary file in memory: magic, version, values, and the seal.
class BinaryWriter : public ByteWriter {
 public:
  /// Throws PreconditionError unless the magic has 8 bytes.
  explicit BinaryWriter(const BinaryKind& kind);
  /// Returns the whole file, with its seal.
  [[nodiscard]] std::string finish() &&;
};

/// Writes a binary file that does not fit into memory: magic, version, values, and the seal. The file appears
/// under its name when it is finished.
class BinaryFileWriter {
 public:
  /// Begins a file; `begin` has magic, version and the first values.
  BinaryFileWriter(const std::filesystem::path& path, const BinaryWriter& begin);
  void write(std::string_view bytes);
  /// Writes the seal and gives the file its name. Returns the checksum that the file ends with.
  std::uint32_t finish();

 private:
  AtomicFile file_;
  BlockSeal seal_;
};

/// Returns the checksum that a sealed file ends with.
[[nodiscard]] std::uint32_t stored_checksum(std::string_view file);

/// Reads the values of a binary file in the order in which they were put (BinaryWriter), with memory for some
/// blocks and the seal only. Checks magic, version and the seal first, and each block before anything of it
/// is returned. Throws InputError that names the file.
class BinaryReader {
 public:
  BinaryReader(const std::filesystem::path& path, const BinaryKind& kind);

  template <class Value>
  /// Returns the next value.
  [[nodiscard]] Value get() {
    static_assert(std::is_arithmetic_v<Value>);
    Value value;
    std::memcpy(&value, get_bytes(sizeof(Value)), sizeof(Value));
    return value;
  }
  /// Returns the next `count` bytes, valid until the next call.
  [[nodiscard]] const char* get_bytes(std::size_t count) {
    if (count > checked_.size() - next_) check_more(count);
    next_ += count;
    return checked_.data() + next_ - count;
  }
  /// Throws InputError unless exactly `count` records of `bytes` bytes (at least 1, at most 2^33), then
  /// `more_count` of `more_bytes`, are left. To be called before making room for them.
  void expect_bytes(std::uint64_t count, std::uint64_t bytes, std::uint64_t more_count = 0,
                    std::uint64_t more_bytes = 1) const;
  /// Throws InputError unless the file ends with this checksum, that is, if it is another file.
  void expect_checksum(std::optional<std::uint32_t> checksum) const;
  /// Throws InputError that names the file and kMapRemedy.
  [[noreturn]] void fail(std::string expected, std::string found) const;

 private:
  void check_beginning(const BinaryKind& kind);
  void read_seal();
  /// Reads and checks blocks until `count` bytes can be returned.
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
