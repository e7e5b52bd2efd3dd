// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/l2_kernels.h"

#include "cairn/simd/integer_vector.h"

namespace cairn::CAIRN_ISA {
namespace {

// With a query's bytes a and packed bytes b, stored as b' = b - 128 in two's complement:
//   |a - b|^2 = |a|^2 + |b|^2 - 2 a.b = (|a|^2 - 256 sum(a)) + |b|^2 - 2 a.b'
// The brackets hold what the query alone decides. Padding is a = b = 0, so that it adds nothing.

inline std::int32_t query_term(const std::uint8_t* query, std::size_t bytes) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < bytes; ++i) sum += (static_cast<std::int32_t>(query[i]) - 256) * query[i];
  return sum;
}

#if defined(__AVX512VNNI__)

/// a.b' of kQueries queries with kGroups groups, in registers.
template <int kQueries, int kGroups>
[[gnu::always_inline]] inline void measure(const DistanceTile& tile, const std::int32_t* terms, std::size_t q,
                                           std::size_t g) {
  const std::size_t words = tile.words;
  __m512i dots[kQueries][kGroups];
  for (int i = 0; i < kQueries; ++i)
    for (int j = 0; j < kGroups; ++j) dots[i][j] = _mm512_setzero_si512();
  for (std::size_t w = 0; w < words; ++w) {
    __m512i packed[kGroups];
    for (int j = 0; j < kGroups; ++j)
      packed[j] =
          _mm512_loadu_si512(tile.packed + ((g + static_cast<std::size_t>(j)) * words + w) * kPackedLanes);
    for (int i = 0; i < kQueries; ++i) {
      std::int32_t word = 0;
      __builtin_memcpy(&word, tile.queries + ((q + static_cast<std::size_t>(i)) * words + w) * 4,
                       sizeof word);
      for (int j = 0; j < kGroups; ++j)
        dots[i][j] = _mm512_dpbusd_epi32(dots[i][j], _mm512_set1_epi32(word), packed[j]);
    }
  }
  for (int i = 0; i < kQueries; ++i) {
    for (int j = 0; j < kGroups; ++j) {
      const std::size_t lane = (g + static_cast<std::size_t>(j)) * kPackedLanes;
      const __m512i both =
          _mm512_add_epi32(_mm512_set1_epi32(terms[i]), _mm512_loadu_si512(tile.squares + lane));
      _mm512_storeu_si512(
          tile.distances + (q + static_cast<std::size_t>(i)) * tile.groups * kPackedLanes + lane,
          _mm512_sub_epi32(both, _mm512_add_epi32(dots[i][j], dots[i][j])));
    }
  }
}

#elif defined(__SSE4_2__)

/// Even and odd bytes of each 32-bit lane as 16-bit numbers.
struct Halves {
  IntVector even, odd;
};
[[gnu::always_inline]] inline Halves unsigned_halves(IntVector v) {
  return {bit_and(v, CAIRN_VECTOR(set1_epi16)(255)), CAIRN_VECTOR(srli_epi16)(v, 8)};
}
[[gnu::always_inline]] inline Halves signed_halves(IntVector v) {
  return {CAIRN_VECTOR(srai_epi16)(CAIRN_VECTOR(slli_epi16)(v, 8), 8), CAIRN_VECTOR(srai_epi16)(v, 8)};
}

/// kQueries queries with kVectorLanes of a group's packed descriptors.
template <int kQueries>
[[gnu::always_inline]] inline void measure_part(const DistanceTile& tile, const std::int32_t* terms,
                                                std::size_t q, std::size_t g, std::size_t lane) {
  const std::uint32_t* packed = tile.packed + g * tile.words * kPackedLanes + lane;
  IntVector dots[kQueries];
  for (int i = 0; i < kQueries; ++i) dots[i] = CAIRN_VECTOR(set1_epi32)(0);
  for (std::size_t w = 0; w < tile.words; ++w) {
    const Halves b = signed_halves(load(packed + w * kPackedLanes));
    for (int i = 0; i < kQueries; ++i) {
      const Halves a = unsigned_halves(
          broadcast32(tile.queries + ((q + static_cast<std::size_t>(i)) * tile.words + w) * 4));
      dots[i] = add32(dots[i], add32(dot16(a.even, b.even), dot16(a.odd, b.odd)));
    }
  }
  for (int i = 0; i < kQueries; ++i) {
    const std::size_t column = g * kPackedLanes + lane;
    const IntVector both = add32(CAIRN_VECTOR(set1_epi32)(terms[i]), load(tile.squares + column));
    store(tile.distances + (q + static_cast<std::size_t>(i)) * tile.groups * kPackedLanes + column,
          CAIRN_VECTOR(sub_epi32)(both, CAIRN_VECTOR(slli_epi32)(dots[i], 1)));
  }
}

template <int kQueries, int kGroups>
[[gnu::always_inline]] inline void measure(const DistanceTile& tile, const std::int32_t* terms, std::size_t q,
                                           std::size_t g) {
  for (std::size_t j = g; j < g + kGroups; ++j)
    for (std::size_t lane = 0; lane < kPackedLanes; lane += kVectorLanes)
      measure_part<kQueries>(tile, terms, q, j, lane);
}

#else

inline std::int32_t signed_byte(std::uint32_t word, unsigned i) {
  return static_cast<std::int32_t>(((word >> (8 * i)) & 255U) ^ 128U) - 128;
}

template <int kQueries, int kGroups>
inline void measure(const DistanceTile& tile, const std::int32_t* terms, std::size_t q, std::size_t g) {
  for (std::size_t i = 0; i < kQueries; ++i) {
    for (std::size_t j = g; j < g + kGroups; ++j) {
      const std::uint32_t* packed = tile.packed + j * tile.words * kPackedLanes;
      std::int32_t dots[kPackedLanes] = {};
      for (std::size_t w = 0; w < tile.words; ++w) {
        const std::uint8_t* a = tile.queries + ((q + i) * tile.words + w) * 4;
        for (unsigned byte = 0; byte < 4; ++byte)
          for (std::size_t lane = 0; lane < kPackedLanes; ++lane)
            dots[lane] += a[byte] * signed_byte(packed[w * kPackedLanes + lane], byte);
      }
      for (std::size_t lane = 0; lane < kPackedLanes; ++lane)
        tile.distances[(q + i) * tile.groups * kPackedLanes + j * kPackedLanes + lane] =
            terms[i] + tile.squares[j * kPackedLanes + lane] - 2 * dots[lane];
    }
  }
}

#endif

template <int kQueries>
inline void measure_all_groups(const DistanceTile& tile, std::size_t q) {
  constexpr int kGroups = 4;  // with as many queries, all sums stay in AVX-512's 32 registers
  std::int32_t terms[kQueries];
  for (std::size_t i = 0; i < kQueries; ++i)
    terms[i] = query_term(tile.queries + (q + i) * tile.words * 4, tile.words * 4);
  std::size_t g = 0;
  for (; g + kGroups <= tile.groups; g += kGroups) measure<kQueries, kGroups>(tile, terms, q, g);
  for (; g < tile.groups; ++g) measure<kQueries, 1>(tile, terms, q, g);
}

void to_packed(const DistanceTile& tile) {
  constexpr int kAtOnce = 4;
  std::size_t q = 0;
  for (; q + kAtOnce <= tile.query_count; q += kAtOnce) measure_all_groups<kAtOnce>(tile, q);
  for (; q < tile.query_count; ++q) measure_all_groups<1>(tile, q);
}

inline std::int32_t squared_distance(const std::uint8_t* a, const std::uint8_t* b, std::size_t words64) {
#if defined(__SSE4_2__)
  __m128i sums = _mm_setzero_si128();
  for (std::size_t i = 0; i < 8 * words64; i += 8) {
    const __m128i x = _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(a + i)));
    const __m128i y = _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(b + i)));
    const __m128i difference = _mm_sub_epi16(x, y);
    sums = _mm_add_epi32(sums, _mm_madd_epi16(difference, difference));
  }
  sums = _mm_add_epi32(sums, _mm_shuffle_epi32(sums, 0x4E));
  return _mm_cvtsi128_si32(_mm_add_epi32(sums, _mm_shuffle_epi32(sums, 0xB1)));
#else
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < 8 * words64; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
#endif
}

void to_rows(const DistanceList& list) {
  for (std::size_t k = 0; k < list.count; ++k)
    list.distances[k] = squared_distance(
        list.query, list.rows + static_cast<std::size_t>(list.indices[k]) * list.words64 * 8, list.words64);
}

}  // namespace

extern const DistanceKernels kL2Kernels;
const DistanceKernels kL2Kernels{to_packed, to_rows};

}  // namespace cairn::CAIRN_ISA
