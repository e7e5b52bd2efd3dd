// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// For kernel sources: a vector of doubles as wide as the instruction set has it, with + - * / of the
/// compiler. What is done lane by lane gives the same bits at any width. Everything has internal linkage, see
/// cmake/kernels.cmake.
namespace cairn::CAIRN_ISA {

#if defined(__AVX512F__)
using DoubleLanes = __m512d;
static inline DoubleLanes load(const double* from) {
  return _mm512_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm512_storeu_pd(to, value);
}
static inline DoubleLanes spread(double value) {
  return _mm512_set1_pd(value);
}
/// Lane by lane: a > b ? a : b.
static inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_GT_OQ), b, a);
}
/// Lane by lane: a > b ? if_greater : otherwise.
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_GT_OQ), otherwise, if_greater);
}
#elif defined(__AVX2__)
using DoubleLanes = __m256d;
static inline DoubleLanes load(const double* from) {
  return _mm256_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm256_storeu_pd(to, value);
}
static inline DoubleLanes spread(double value) {
  return _mm256_set1_pd(value);
}
static inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return _mm256_max_pd(a, b);
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return _mm256_blendv_pd(otherwise, if_greater, _mm256_cmp_pd(a, b, _CMP_GT_OQ));
}
#elif defined(__SSE2__)
using DoubleLanes = __m128d;
static inline DoubleLanes load(const double* from) {
  return _mm_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm_storeu_pd(to, value);
}
static inline DoubleLanes spread(double value) {
  return _mm_set1_pd(value);
}
static inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return _mm_max_pd(a, b);
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  const DoubleLanes greater = _mm_cmpgt_pd(a, b);
  return _mm_or_pd(_mm_and_pd(greater, if_greater), _mm_andnot_pd(greater, otherwise));
}
#else
using DoubleLanes = double;
static inline DoubleLanes load(const double* from) {
  return *from;
}
static inline void store(double* to, DoubleLanes value) {
  *to = value;
}
static inline DoubleLanes spread(double value) {
  return value;
}
static inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return a > b ? a : b;
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return a > b ? if_greater : otherwise;
}
#endif

constexpr int kDoubleLanes = static_cast<int>(sizeof(DoubleLanes) / sizeof(double));

}  // namespace cairn::CAIRN_ISA
