// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// For kernel sources: a vector of floats as wide as the instruction set has it, with + - * / of the
/// compiler. Lane-by-lane operations give the same bits at any width. Everything has internal linkage, see
/// cmake/kernels.cmake.
namespace cairn::CAIRN_ISA {

#if defined(__AVX512F__)
using Lanes = __m512;
constexpr __mmask16 kAll =
    0xFFFF;  // the unmasked functions of g++ 12 warn of their own uninitialised operand
static inline Lanes load(const float* from) {
  return _mm512_loadu_ps(from);
}
static inline void store(float* to, Lanes value) {
  _mm512_storeu_ps(to, value);
}
static inline Lanes broadcast(float value) {
  return _mm512_set1_ps(value);
}
static inline Lanes larger(Lanes a, Lanes b) {
  return _mm512_maskz_max_ps(kAll, a, b);
}
static inline Lanes smaller(Lanes a, Lanes b) {
  return _mm512_maskz_min_ps(kAll, a, b);
}
/// Returns a mask: bit l is set if a >= b in lane l.
static inline unsigned at_least(Lanes a, Lanes b) {
  return _mm512_cmp_ps_mask(a, b, _CMP_GE_OQ);
}
/// Selects lane by lane: a > b ? if_greater : otherwise.
static inline Lanes choose(Lanes a, Lanes b, Lanes if_greater, Lanes otherwise) {
  return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(a, b, _CMP_GT_OQ), otherwise, if_greater);
}
static inline Lanes square_root(Lanes a) {
  return _mm512_maskz_sqrt_ps(kAll, a);
}
/// Stores the values as integers, rounded towards zero.
static inline void store_truncated(int* to, Lanes value) {
  _mm512_storeu_si512(to, _mm512_maskz_cvttps_epi32(kAll, value));
}
#elif defined(__AVX2__)
using Lanes = __m256;
static inline Lanes load(const float* from) {
  return _mm256_loadu_ps(from);
}
static inline void store(float* to, Lanes value) {
  _mm256_storeu_ps(to, value);
}
static inline Lanes broadcast(float value) {
  return _mm256_set1_ps(value);
}
static inline Lanes larger(Lanes a, Lanes b) {
  return _mm256_max_ps(a, b);
}
static inline Lanes smaller(Lanes a, Lanes b) {
  return _mm256_min_ps(a, b);
}
static inline unsigned at_least(Lanes a, Lanes b) {
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GE_OQ)));
}
static inline Lanes choose(Lanes a, Lanes b, Lanes if_greater, Lanes otherwise) {
  return _mm256_blendv_ps(otherwise, if_greater, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
}
static inline Lanes square_root(Lanes a) {
  return _mm256_sqrt_ps(a);
}
static inline void store_truncated(int* to, Lanes value) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(value));
}
#elif defined(__SSE2__)
using Lanes = __m128;
static inline Lanes load(const float* from) {
  return _mm_loadu_ps(from);
}
static inline void store(float* to, Lanes value) {
  _mm_storeu_ps(to, value);
}
static inline Lanes broadcast(float value) {
  return _mm_set1_ps(value);
}
static inline Lanes larger(Lanes a, Lanes b) {
  return _mm_max_ps(a, b);
}
static inline Lanes smaller(Lanes a, Lanes b) {
  return _mm_min_ps(a, b);
}
static inline unsigned at_least(Lanes a, Lanes b) {
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpge_ps(a, b)));
}
static inline Lanes choose(Lanes a, Lanes b, Lanes if_greater, Lanes otherwise) {
  const Lanes greater = _mm_cmpgt_ps(a, b);
  return _mm_or_ps(_mm_and_ps(greater, if_greater), _mm_andnot_ps(greater, otherwise));
}
static inline Lanes square_root(Lanes a) {
  return _mm_sqrt_ps(a);
}
static inline void store_truncated(int* to, Lanes value) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_cvttps_epi32(value));
}
#else
using Lanes = float;
static inline Lanes load(const float* from) {
  return *from;
}
static inline void store(float* to, Lanes value) {
  *to = value;
}
static inline Lanes broadcast(float value) {
  return value;
}
static inline Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
static inline Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
static inline unsigned at_least(Lanes a, Lanes b) {
  return a >= b ? 1U : 0U;
}
static inline Lanes choose(Lanes a, Lanes b, Lanes if_greater, Lanes otherwise) {
  return a > b ? if_greater : otherwise;
}
static inline Lanes square_root(Lanes a) {
  return __builtin_sqrtf(a);
}
static inline void store_truncated(int* to, Lanes value) {
  *to = static_cast<int>(value);
}
#endif

constexpr int kLanes = static_cast<int>(sizeof(Lanes) / sizeof(float));

}  // namespace cairn::CAIRN_ISA
