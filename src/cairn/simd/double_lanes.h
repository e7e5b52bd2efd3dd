// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// For kernel sources: a vector of doubles as wide as the instruction set has it, with + - * / of the
/// compiler. Lane-by-lane operations give the same bits at any width. Everything has internal linkage, see
/// cmake/kernels.cmake.
namespace cairn::CAIRN_ISA {

#if defined(__AVX512F__)
using DoubleLanes = __m512d;
constexpr __mmask8 kAllEight = 0xFF;  // unmasked, g++ 12 warns of its own uninitialised operand
static inline DoubleLanes load(const double* from) {
  return _mm512_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm512_storeu_pd(to, value);
}
static inline DoubleLanes broadcast(double value) {
  return _mm512_set1_pd(value);
}
/// Selects lane by lane: a > b ? if_greater : otherwise.
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_GT_OQ), otherwise, if_greater);
}
/// Adds the upper to the lower half of `a` and of `b`; returns both sums side by side.
static inline DoubleLanes both_halves(DoubleLanes a, DoubleLanes b) {
  return _mm512_maskz_shuffle_f64x2(kAllEight, a, b, 0x44) +
         _mm512_maskz_shuffle_f64x2(kAllEight, a, b, 0xEE);
}
/// Adds the odd to the even pairs of lanes of `a` and of `b`; returns both sums side by side.
static inline DoubleLanes both_quarters(DoubleLanes a, DoubleLanes b) {
  return _mm512_maskz_shuffle_f64x2(kAllEight, a, b, 0x88) +
         _mm512_maskz_shuffle_f64x2(kAllEight, a, b, 0xDD);
}
/// Adds up eights 0, 2, 4 and 6 to two lanes each.
static inline DoubleLanes fours(const DoubleLanes (*eights)[1]) {
  return both_quarters(both_halves(eights[0][0], eights[2][0]), both_halves(eights[4][0], eights[6][0]));
}
/// Computes the sums of eight times eight lanes, each in as many vectors as they fill, in one order for all
/// widths: (l0 + l4) + (l2 + l6) plus (l1 + l5) + (l3 + l7).
static inline void add_eights(const DoubleLanes (*eights)[1], double* sums) {
  const DoubleLanes even = fours(eights), odd = fours(eights + 1);
  store(sums,
        _mm512_maskz_unpacklo_pd(kAllEight, even, odd) + _mm512_maskz_unpackhi_pd(kAllEight, even, odd));
}
#elif defined(__AVX2__)
using DoubleLanes = __m256d;
static inline DoubleLanes load(const double* from) {
  return _mm256_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm256_storeu_pd(to, value);
}
static inline DoubleLanes broadcast(double value) {
  return _mm256_set1_pd(value);
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return _mm256_blendv_pd(otherwise, if_greater, _mm256_cmp_pd(a, b, _CMP_GT_OQ));
}
/// Computes the sum of eight lanes, in the order of add_eights.
static inline double add_eight(const DoubleLanes* eight) {
  const __m256d four = eight[0] + eight[1];
  const __m128d two = _mm256_castpd256_pd128(four) + _mm256_extractf128_pd(four, 1);
  return _mm_cvtsd_f64(two) + _mm_cvtsd_f64(_mm_unpackhi_pd(two, two));
}
#elif defined(__SSE2__)
using DoubleLanes = __m128d;
static inline DoubleLanes load(const double* from) {
  return _mm_loadu_pd(from);
}
static inline void store(double* to, DoubleLanes value) {
  _mm_storeu_pd(to, value);
}
static inline DoubleLanes broadcast(double value) {
  return _mm_set1_pd(value);
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  const DoubleLanes greater = _mm_cmpgt_pd(a, b);
  return _mm_or_pd(_mm_and_pd(greater, if_greater), _mm_andnot_pd(greater, otherwise));
}
/// Computes the sum of eight lanes, in the order of add_eights.
static inline double add_eight(const DoubleLanes* eight) {
  const __m128d two = (eight[0] + eight[2]) + (eight[1] + eight[3]);
  return _mm_cvtsd_f64(two) + _mm_cvtsd_f64(_mm_unpackhi_pd(two, two));
}
#else
using DoubleLanes = double;
static inline DoubleLanes load(const double* from) {
  return *from;
}
static inline void store(double* to, DoubleLanes value) {
  *to = value;
}
static inline DoubleLanes broadcast(double value) {
  return value;
}
static inline DoubleLanes choose(DoubleLanes a, DoubleLanes b, DoubleLanes if_greater,
                                 DoubleLanes otherwise) {
  return a > b ? if_greater : otherwise;
}
/// Computes the sum of eight lanes, in the order of add_eights.
static inline double add_eight(const DoubleLanes* eight) {
  return ((eight[0] + eight[4]) + (eight[2] + eight[6])) + ((eight[1] + eight[5]) + (eight[3] + eight[7]));
}
#endif

constexpr int kDoubleLanes = static_cast<int>(sizeof(DoubleLanes) / sizeof(double));

#if !defined(__AVX512F__)
static inline void add_eights(const DoubleLanes (*eights)[8 / kDoubleLanes], double* sums) {
  for (int i = 0; i < 8; ++i) sums[i] = add_eight(eights[i]);
}
#endif

}  // namespace cairn::CAIRN_ISA
