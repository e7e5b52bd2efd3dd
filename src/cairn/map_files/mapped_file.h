// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

#include "cairn/map_files/binary_file.h"

namespace cairn {

/// Maps a sealed binary file into memory. Only the seal is read when it is opened; each block of the file is
/// checked when it is first asked for. Throws InputError that names the file. Safe to use from several
/// threads.
class MappedFile {
 public:
  /// Opens the file; `checksum` is what map.json has for it.
  MappedFile(const std::filesystem::path& path, const BinaryKind& kind,
             std::optional<std::uint32_t> checksum);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// Returns the number of bytes before the seal.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Returns `count` bytes from `offset` on, valid as long as this object. Throws InputError if they are not
  /// all in the file.
  [[nodiscard]] const char* bytes(std::uint64_t offset, std::uint64_t count) const;
  /// Prefetches bytes that are needed soon, without checking them.
  void fetch(std::uint64_t offset, std::uint64_t count) const;
  /// Allows the system to drop what was read so far from memory; it is read again if asked for.
  void forget() const;
  /// Returns the size of all blocks that were asked for so far, that is, how much of the file was read,
  /// bytes.
  [[nodiscard]] std::uint64_t touched_bytes() const;
  template <class Value>
  /// Returns the value at `offset`.
  [[nodiscard]] Value at(std::uint64_t offset) const {
    static_assert(std::is_arithmetic_v<Value>);
    Value value;
    std::memcpy(&value, bytes(offset, sizeof(Value)), sizeof(Value));
    return value;
  }
  /// Returns `count` values from `offset` on, which is a multiple of their size.
  template <class Value>
  [[nodiscard]] std::span<const Value> values(std::uint64_t offset, std::uint64_t count) const {
    static_assert(std::is_arithmetic_v<Value>);
    return {reinterpret_cast<const Value*>(bytes(offset, count * sizeof(Value))), count};
  }
  /// Throws InputError that names the file and kMapRemedy.
  [[noreturn]] void fail(std::string expected, std::string found) const;

 private:
  void map_contents();
  void check_seal(const BinaryKind& kind, std::optional<std::uint32_t> checksum);
  void check_block(std::uint64_t block) const;

  std::filesystem::path path_;
  const char* contents_ = nullptr;
  std::uint64_t file_bytes_ = 0, size_ = 0;
  mutable std::unique_ptr<std::atomic<bool>[]> checked_;  // by block
};

/// Reads the whole file piece by piece. Throws InputError unless it is of this kind, sealed, and ends with
/// this checksum.
void check_sealed_file(const std::filesystem::path& path, const BinaryKind& kind,
                       std::optional<std::uint32_t> checksum);

}  // namespace cairn
