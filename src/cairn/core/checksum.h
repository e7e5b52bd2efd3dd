// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn {

/// Returns zlib's CRC-32 of the bytes, as PNG and gzip use it; 0 for no bytes.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// Computes the CRC-32 of bytes that come piece by piece.
class Crc32 {
 public:
  Crc32() = default;
  /// Continues after bytes that have the CRC-32 `value`.
  explicit Crc32(std::uint32_t value) : value_(value) {}
  /// Appends bytes; no bytes leave the value unchanged.
  void add(std::string_view bytes);
  /// Returns the CRC-32 of all bytes so far.
  [[nodiscard]] std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

}  // namespace cairn
