// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/checksum.h"

#include <array>
#include <bit>
#include <cstring>

namespace cairn {
namespace {

using Table = std::array<std::uint32_t, 256>;

/// tables[k][b]: what byte b does to the remainder, k bytes later. Eight bytes at a time (Kounavis and Berry
/// 2005, "A systematic approach to building high performance software-based CRC generators").
constexpr std::array<Table, 8> make_tables() {
  std::array<Table, 8> tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1) : value >> 1;
    tables[0][i] = value;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::uint32_t i = 0; i < 256; ++i)
      tables[k][i] = tables[0][tables[k - 1][i] & 0xFFU] ^ (tables[k - 1][i] >> 8);
  return tables;
}

constexpr std::array<Table, 8> kTables = make_tables();

std::uint32_t add_eight(std::uint32_t remainder, const char* bytes) {
  static_assert(std::endian::native == std::endian::little, "the tables are used in this order of bytes");
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  word ^= remainder;
  std::uint32_t result = 0;
  for (std::size_t k = 0; k < 8; ++k) result ^= kTables[7 - k][(word >> (8 * k)) & 0xFFU];
  return result;
}

}  // namespace

void Crc32::add(std::string_view bytes) {
  std::uint32_t remainder = value_ ^ 0xFFFFFFFFU;
  while (bytes.size() >= 8) {
    remainder = add_eight(remainder, bytes.data());
    bytes.remove_prefix(8);
  }
  for (const char byte : bytes)
    remainder = kTables[0][(remainder ^ static_cast<std::uint8_t>(byte)) & 0xFFU] ^ (remainder >> 8);
  value_ = remainder ^ 0xFFFFFFFFU;
}

std::uint32_t crc32(std::string_view bytes) {
  Crc32 checksum;
  checksum.add(bytes);
  return checksum.value();
}

}  // namespace cairn
