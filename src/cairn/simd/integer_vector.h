// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Wraps the integer instructions that SSE4.2 and AVX2 share, so that a kernel is written once for both. All
/// are static: each instruction set's object has its own.
#if defined(__SSE4_2__)
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace cairn {

#if defined(__AVX2__)
#define CAIRN_VECTOR(operation) _mm256_##operation
using IntVector = __m256i;
[[gnu::always_inline]] static inline IntVector load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
[[gnu::always_inline]] static inline void store(void* to, IntVector v) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), v);
}
[[gnu::always_inline]] static inline IntVector bit_and(IntVector a, IntVector b) {
  return _mm256_and_si256(a, b);
}
[[gnu::always_inline]] static inline IntVector bit_xor(IntVector a, IntVector b) {
  return _mm256_xor_si256(a, b);
}
/// Loads 16 bytes into each half.
[[gnu::always_inline]] static inline IntVector repeat16(const void* from) {
  return _mm256_broadcastsi128_si256(_mm_loadu_si128(static_cast<const __m128i*>(from)));
}
#else
#define CAIRN_VECTOR(operation) _mm_##operation
using IntVector = __m128i;
[[gnu::always_inline]] static inline IntVector load(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
[[gnu::always_inline]] static inline void store(void* to, IntVector v) {
  _mm_storeu_si128(static_cast<__m128i*>(to), v);
}
[[gnu::always_inline]] static inline IntVector bit_and(IntVector a, IntVector b) {
  return _mm_and_si128(a, b);
}
[[gnu::always_inline]] static inline IntVector bit_xor(IntVector a, IntVector b) {
  return _mm_xor_si128(a, b);
}
[[gnu::always_inline]] static inline IntVector repeat16(const void* from) {
  return load(from);
}
#endif

inline constexpr std::size_t kVectorLanes = sizeof(IntVector) / 4;  ///< number of 32-bit lanes

[[gnu::always_inline]] static inline IntVector add32(IntVector a, IntVector b) {
  return CAIRN_VECTOR(add_epi32)(a, b);
}
[[gnu::always_inline]] static inline IntVector add8(IntVector a, IntVector b) {
  return CAIRN_VECTOR(add_epi8)(a, b);
}
/// Computes the sums of products of pairs of 16-bit numbers, 32 bits each.
[[gnu::always_inline]] static inline IntVector dot16(IntVector a, IntVector b) {
  return CAIRN_VECTOR(madd_epi16)(a, b);
}
[[gnu::always_inline]] static inline IntVector broadcast32(const void* from) {
  std::int32_t word = 0;
  __builtin_memcpy(&word, from, sizeof word);
  return CAIRN_VECTOR(set1_epi32)(word);
}

}  // namespace cairn
#endif
