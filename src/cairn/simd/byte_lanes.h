// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

/// Bytes side by side in the widest register of the instruction set that the including kernel is compiled
/// for; one byte where there is none. For kernel sources only.
namespace cairn::CAIRN_ISA {
namespace {

#if defined(__AVX512BW__)
/// Holds 64 bytes in a register of AVX-512.
struct Bytes {
  static constexpr int kCount = 64;
  __m512i v;

  static Bytes load(const std::uint8_t* p) { return {_mm512_loadu_si512(p)}; }
  static Bytes fill(int value) { return {_mm512_set1_epi8(static_cast<char>(value))}; }
  void store(std::uint8_t* p) const { _mm512_storeu_si512(p, v); }
  /// Returns a mask: bit i is set if byte i is not below the other's.
  [[nodiscard]] std::uint64_t not_below(Bytes other) const { return _mm512_cmpge_epu8_mask(v, other.v); }
  /// Returns the bytes, with 0 for those below the other's.
  [[nodiscard]] Bytes cut_below(Bytes other) const {
    return {_mm512_maskz_mov_epi8(_mm512_cmpge_epu8_mask(v, other.v), v)};
  }
};
/// Subtracts; a negative result becomes 0.
inline Bytes minus(Bytes a, Bytes b) {
  return {_mm512_subs_epu8(a.v, b.v)};
}
/// Returns the smaller byte of each pair.
inline Bytes least(Bytes a, Bytes b) {
  return {_mm512_min_epu8(a.v, b.v)};
}
/// Returns the larger byte of each pair.
inline Bytes most(Bytes a, Bytes b) {
  return {_mm512_max_epu8(a.v, b.v)};
}
#elif defined(__AVX2__)
/// Holds 32 bytes in a register of AVX2.
struct Bytes {
  static constexpr int kCount = 32;
  __m256i v;

  static Bytes load(const std::uint8_t* p) {
    return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
  }
  static Bytes fill(int value) { return {_mm256_set1_epi8(static_cast<char>(value))}; }
  void store(std::uint8_t* p) const { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v); }
  /// Returns a mask: bit i is set if byte i is not below the other's.
  [[nodiscard]] std::uint64_t not_below(Bytes other) const {
    return static_cast<std::uint32_t>(
        _mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_max_epu8(v, other.v), v)));
  }
  /// Returns the bytes, with 0 for those below the other's.
  [[nodiscard]] Bytes cut_below(Bytes other) const {
    return {_mm256_and_si256(v, _mm256_cmpeq_epi8(_mm256_max_epu8(v, other.v), v))};
  }
};
/// Subtracts; a negative result becomes 0.
inline Bytes minus(Bytes a, Bytes b) {
  return {_mm256_subs_epu8(a.v, b.v)};
}
/// Returns the smaller byte of each pair.
inline Bytes least(Bytes a, Bytes b) {
  return {_mm256_min_epu8(a.v, b.v)};
}
/// Returns the larger byte of each pair.
inline Bytes most(Bytes a, Bytes b) {
  return {_mm256_max_epu8(a.v, b.v)};
}
#elif defined(__SSE4_2__)
/// Holds 16 bytes in a register of SSE.
struct Bytes {
  static constexpr int kCount = 16;
  __m128i v;

  static Bytes load(const std::uint8_t* p) { return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))}; }
  static Bytes fill(int value) { return {_mm_set1_epi8(static_cast<char>(value))}; }
  void store(std::uint8_t* p) const { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), v); }
  /// Returns a mask: bit i is set if byte i is not below the other's.
  [[nodiscard]] std::uint64_t not_below(Bytes other) const {
    return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(v, other.v), v)));
  }
  /// Returns the bytes, with 0 for those below the other's.
  [[nodiscard]] Bytes cut_below(Bytes other) const {
    return {_mm_and_si128(v, _mm_cmpeq_epi8(_mm_max_epu8(v, other.v), v))};
  }
};
/// Subtracts; a negative result becomes 0.
inline Bytes minus(Bytes a, Bytes b) {
  return {_mm_subs_epu8(a.v, b.v)};
}
/// Returns the smaller byte of each pair.
inline Bytes least(Bytes a, Bytes b) {
  return {_mm_min_epu8(a.v, b.v)};
}
/// Returns the larger byte of each pair.
inline Bytes most(Bytes a, Bytes b) {
  return {_mm_max_epu8(a.v, b.v)};
}
#endif

/// Holds one byte: the plain version, and the rest at the end of a row.
struct Byte {
  static constexpr int kCount = 1;
  std::uint8_t v;

  static Byte load(const std::uint8_t* p) { return {*p}; }
  static Byte fill(int value) { return {static_cast<std::uint8_t>(value)}; }
  void store(std::uint8_t* p) const { *p = v; }
  [[nodiscard]] std::uint64_t not_below(Byte other) const { return v >= other.v ? 1 : 0; }
  /// Returns the byte, or 0 if it is below the other.
  [[nodiscard]] Byte cut_below(Byte other) const { return v >= other.v ? *this : Byte{0}; }
};
/// Subtracts; a negative result becomes 0.
inline Byte minus(Byte a, Byte b) {
  return {static_cast<std::uint8_t>(a.v > b.v ? a.v - b.v : 0)};
}
inline Byte least(Byte a, Byte b) {
  return a.v < b.v ? a : b;
}
inline Byte most(Byte a, Byte b) {
  return a.v > b.v ? a : b;
}

#if !defined(__SSE4_2__)
using Bytes = Byte;
#endif

}  // namespace
}  // namespace cairn::CAIRN_ISA
