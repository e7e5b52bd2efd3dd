// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn {

/// CRC-32 as in zlib, PNG and Python's zlib.crc32 (polynomial 0xEDB88320, reflected).
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// The same of bytes that come piece by piece.
class Crc32 {
 public:
  Crc32() = default;
  /// Goes on after bytes that have this CRC-32.
  explicit Crc32(std::uint32_t value) : value_(value) {}
  void add(std::string_view bytes);
  [[nodiscard]] std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

}  // namespace cairn
