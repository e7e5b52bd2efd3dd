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

/// A sealed binary file mapped into memory. Only the seal is read when it is opened; the blocks of the file
/// are checked when they are first asked for. InputError names the file. Safe to use from several threads.
class MappedFile {
 public:
  /// `checksum` is what map.json has for the file.
  MappedFile(const std::filesystem::path& path, const BinaryKind& kind,
             std::optional<std::uint32_t> checksum);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// Bytes before the seal.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// `count` bytes from `offset` on, which lie in the file; valid as long as this.
  [[nodiscard]] const char* bytes(std::uint64_t offset, std::uint64_t count) const;
  /// Asks the memory for bytes that are wanted soon, so that they need not be waited for.
  void fetch(std::uint64_t offset, std::uint64_t count) const;
  /// The memory may do without what was read so far; it is read again when it is asked for.
  void forget() const;
  /// Returns the bytes of all blocks that were asked for so far: what was read of the file.
  [[nodiscard]] std::uint64_t touched_bytes() const;
  template <class Value>
  [[nodiscard]] Value at(std::uint64_t offset) const {
    static_assert(std::is_arithmetic_v<Value>);
    Value value;
    std::memcpy(&value, bytes(offset, sizeof(Value)), sizeof(Value));
    return value;
  }
  /// `count` values from `offset` on, which is a multiple of their size.
  template <class Value>
  [[nodiscard]] std::span<const Value> values(std::uint64_t offset, std::uint64_t count) const {
    static_assert(std::is_arithmetic_v<Value>);
    return {reinterpret_cast<const Value*>(bytes(offset, count * sizeof(Value))), count};
  }
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

/// Reads the whole file piece by piece. InputError unless it is of this kind, sealed, and ends with this
/// checksum.
void check_sealed_file(const std::filesystem::path& path, const BinaryKind& kind,
                       std::optional<std::uint32_t> checksum);

}  // namespace cairn
