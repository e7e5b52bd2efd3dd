// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/hamming_kernels.h"

#include "cairn/simd/integer_vector.h"

namespace cairn::CAIRN_ISA {
namespace {

#if defined(__AVX512VPOPCNTDQ__)

/// kQueries queries at once, so that a word of 16 packed descriptors is loaded once for all.
template <int kQueries>
[[gnu::always_inline]] inline void count_bits(const DistanceTile& tile, std::size_t q, std::size_t g) {
  const std::uint32_t* packed = tile.packed + g * tile.words * kPackedLanes;
  const std::uint8_t* queries = tile.queries + q * tile.words * 4;
  __m512i bits[kQueries];
  for (int i = 0; i < kQueries; ++i) bits[i] = _mm512_setzero_si512();
  for (std::size_t w = 0; w < tile.words; ++w) {
    const __m512i words = _mm512_loadu_si512(packed + w * kPackedLanes);
    for (int i = 0; i < kQueries; ++i) {
      std::int32_t word = 0;
      __builtin_memcpy(&word, queries + (static_cast<std::size_t>(i) * tile.words + w) * 4, sizeof word);
      const __m512i different = _mm512_xor_si512(words, _mm512_set1_epi32(word));
      bits[i] = _mm512_add_epi32(bits[i], _mm512_popcnt_epi32(different));
    }
  }
  for (int i = 0; i < kQueries; ++i)
    _mm512_storeu_si512(
        tile.distances + (q + static_cast<std::size_t>(i)) * tile.groups * kPackedLanes + g * kPackedLanes,
        bits[i]);
}

#elif defined(__SSE4_2__)

/// Bits of each byte, by looking its halves up in a table of 16 (Mula, Kurz, Lemire: "Faster Population
/// Counts Using AVX2 Instructions", 2018, sec. 2).
[[gnu::always_inline]] inline IntVector bits_of_bytes(IntVector v, IntVector table, IntVector low_half) {
  const IntVector low = bit_and(v, low_half), high = bit_and(CAIRN_VECTOR(srli_epi16)(v, 4), low_half);
  return add8(CAIRN_VECTOR(shuffle_epi8)(table, low), CAIRN_VECTOR(shuffle_epi8)(table, high));
}

/// The four bytes of each 32-bit lane, unsigned.
[[gnu::always_inline]] inline IntVector sum_bytes(IntVector bytes) {
  return dot16(CAIRN_VECTOR(maddubs_epi16)(bytes, CAIRN_VECTOR(set1_epi8)(1)), CAIRN_VECTOR(set1_epi16)(1));
}

/// One query against kVectorLanes of the packed.
[[gnu::always_inline]] inline IntVector count_bits(const std::uint8_t* query, const std::uint32_t* packed,
                                                   std::size_t words) {
  constexpr std::size_t kUntilFull = 31;  // words that bytes can count: 31 * 8 < 256
  alignas(16) static constexpr std::uint8_t kBits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
  const IntVector table = repeat16(kBits), low_half = CAIRN_VECTOR(set1_epi8)(15);
  IntVector total = CAIRN_VECTOR(set1_epi32)(0);
  for (std::size_t begin = 0; begin < words; begin += kUntilFull) {
    const std::size_t end = words - begin < kUntilFull ? words : begin + kUntilFull;
    IntVector bytes = CAIRN_VECTOR(set1_epi32)(0);
    for (std::size_t w = begin; w < end; ++w) {
      const IntVector different = bit_xor(load(packed + w * kPackedLanes), broadcast32(query + 4 * w));
      bytes = add8(bytes, bits_of_bytes(different, table, low_half));
    }
    total = add32(total, sum_bytes(bytes));
  }
  return total;
}

template <int kQueries>
[[gnu::always_inline]] inline void count_bits(const DistanceTile& tile, std::size_t q, std::size_t g) {
  const std::uint32_t* packed = tile.packed + g * tile.words * kPackedLanes;
  for (std::size_t i = q; i < q + kQueries; ++i) {
    for (std::size_t lane = 0; lane < kPackedLanes; lane += kVectorLanes)
      store(tile.distances + i * tile.groups * kPackedLanes + g * kPackedLanes + lane,
            count_bits(tile.queries + i * tile.words * 4, packed + lane, tile.words));
  }
}

#else

/// Warren, "Hacker's Delight", fig. 5-2.
inline std::uint32_t count_bits(std::uint32_t x) {
  x -= (x >> 1) & 0x55555555U;
  x = (x & 0x33333333U) + ((x >> 2) & 0x33333333U);
  x = (x + (x >> 4)) & 0x0F0F0F0FU;
  return (x * 0x01010101U) >> 24;
}

template <int kQueries>
inline void count_bits(const DistanceTile& tile, std::size_t q, std::size_t g) {
  const std::uint32_t* packed = tile.packed + g * tile.words * kPackedLanes;
  for (std::size_t i = q; i < q + kQueries; ++i) {
    std::int32_t* distances = tile.distances + i * tile.groups * kPackedLanes + g * kPackedLanes;
    for (std::size_t lane = 0; lane < kPackedLanes; ++lane) distances[lane] = 0;
    for (std::size_t w = 0; w < tile.words; ++w) {
      std::uint32_t word = 0;
      __builtin_memcpy(&word, tile.queries + (i * tile.words + w) * 4, sizeof word);
      for (std::size_t lane = 0; lane < kPackedLanes; ++lane)
        distances[lane] += static_cast<std::int32_t>(count_bits(packed[w * kPackedLanes + lane] ^ word));
    }
  }
}

#endif

void to_packed(const DistanceTile& tile) {
  constexpr int kAtOnce = 4;
  std::size_t q = 0;
  for (; q + kAtOnce <= tile.query_count; q += kAtOnce)
    for (std::size_t g = 0; g < tile.groups; ++g) count_bits<kAtOnce>(tile, q, g);
  for (; q < tile.query_count; ++q)
    for (std::size_t g = 0; g < tile.groups; ++g) count_bits<1>(tile, q, g);
}

void to_rows(const DistanceList& list) {
  for (std::size_t k = 0; k < list.count; ++k) {
    const std::uint8_t* row = list.rows + static_cast<std::size_t>(list.indices[k]) * list.words64 * 8;
    int bits = 0;
    for (std::size_t w = 0; w < list.words64; ++w) {
      std::uint64_t a = 0, b = 0;
      __builtin_memcpy(&a, list.query + 8 * w, sizeof a);
      __builtin_memcpy(&b, row + 8 * w, sizeof b);
      bits += __builtin_popcountll(a ^ b);
    }
    list.distances[k] = bits;
  }
}

}  // namespace

extern const DistanceKernels kHammingKernels;
const DistanceKernels kHammingKernels{to_packed, to_rows};

}  // namespace cairn::CAIRN_ISA
