// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/orb_kernels.h"

#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

namespace cairn::CAIRN_ISA {
namespace {

constexpr int kDiscSide = 32;  // columns -15 to 16; the last is never in the disc

/// For each row of the disc, from its middle outwards: u where the pixel is inside, 0 elsewhere; and 1 where
/// it is inside.
struct Disc {
  alignas(32) std::int8_t u[kMomentRadius + 1][kDiscSide]{};
  alignas(32) std::int8_t inside[kMomentRadius + 1][kDiscSide]{};
};

constexpr Disc make_disc() {
  Disc disc;
  for (int v = 0; v <= kMomentRadius; ++v) {
    for (int i = 0; i < kDiscSide; ++i) {
      const int u = i - kMomentRadius;
      if (u * u + v * v > kMomentRadius * kMomentRadius) continue;
      disc.u[v][i] = static_cast<std::int8_t>(u);
      disc.inside[v][i] = 1;
    }
  }
  return disc;
}

constexpr Disc kDisc = make_disc();

#if defined(__AVX512VNNI__)
std::int32_t sum_of(__m256i v) {
  const __m128i four = _mm_add_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  const __m128i two = _mm_add_epi32(four, _mm_shuffle_epi32(four, 0x4e));
  return _mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 0xb1)));
}

void moments(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01) {
  const auto row = [&](int v) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pixel + v * stride - kMomentRadius));
  };
  const auto weights = [](const std::int8_t* w) {
    return _mm256_load_si256(reinterpret_cast<const __m256i*>(w));
  };
  const __m256i zero = _mm256_setzero_si256();
  __m256i along_u = _mm256_dpbusd_epi32(zero, row(0), weights(kDisc.u[0])), along_v = zero;
  for (int v = 1; v <= kMomentRadius; ++v) {
    const __m256i above = row(-v), below = row(v), u = weights(kDisc.u[v]), inside = weights(kDisc.inside[v]);
    along_u = _mm256_dpbusd_epi32(_mm256_dpbusd_epi32(along_u, above, u), below, u);
    const __m256i difference =
        _mm256_sub_epi32(_mm256_dpbusd_epi32(zero, below, inside), _mm256_dpbusd_epi32(zero, above, inside));
    along_v = _mm256_add_epi32(along_v, _mm256_mullo_epi32(difference, _mm256_set1_epi32(v)));
  }
  *m10 = sum_of(along_u);
  *m01 = sum_of(along_v);
}
#else
void moments(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* m10, std::int32_t* m01) {
  std::int32_t along_u = 0, along_v = 0;
  for (int v = -kMomentRadius; v <= kMomentRadius; ++v) {
    const std::uint8_t* row = pixel + v * stride - kMomentRadius;
    const int from_middle = v < 0 ? -v : v;
    std::int32_t weighted = 0, sum = 0;
    for (int i = 0; i < kDiscSide; ++i) {
      weighted += kDisc.u[from_middle][i] * row[i];
      sum += kDisc.inside[from_middle][i] * row[i];
    }
    along_u += weighted;
    along_v += v * sum;
  }
  *m10 = along_u;
  *m01 = along_v;
}
#endif

/// 1.5 * 2^23: a float added to it has its fraction rounded away, to even, and is left as an integer in the
/// low bits.
constexpr float kRounder = 12582912.0F;
constexpr std::int32_t kRounderBits = 0x4B400000;

std::int32_t rounded(float value) {
  std::int32_t bits = 0;
  const float shifted = value + kRounder;
  __builtin_memcpy(&bits, &shifted, sizeof bits);
  return bits - kRounderBits;
}

void brief(const std::uint8_t* pixel, std::ptrdiff_t stride, const BriefPattern& pattern, float cosine,
           float sine, std::uint8_t* bits) {
  std::int32_t offset[2 * kBriefBits];
  const auto row = static_cast<std::int32_t>(stride);
  for (int i = 0; i < 2 * kBriefBits; ++i) {
    const float u = pattern.u[i] * cosine - pattern.v[i] * sine;
    const float v = pattern.u[i] * sine + pattern.v[i] * cosine;
    offset[i] = rounded(v) * row + rounded(u);
  }
#if defined(__AVX512BW__)
  // Four bytes are gathered for each pixel and the first one kept; what lies behind the patch is still image.
  const auto values = [&](int i) {
    const __m512i gathered =
        _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, _mm512_loadu_si512(offset + i), pixel, 1);
    return _mm512_and_si512(gathered, _mm512_set1_epi32(0xff));
  };
  for (int i = 0; i < kBriefBits; i += 16) {
    const auto less = static_cast<std::uint16_t>(_mm512_cmplt_epu32_mask(values(i), values(kBriefBits + i)));
    __builtin_memcpy(bits + i / 8, &less, sizeof less);
  }
#else
  alignas(16) std::uint8_t value[2 * kBriefBits];
  for (int i = 0; i < 2 * kBriefBits; ++i) value[i] = pixel[offset[i]];
  const std::uint8_t *first = value, *second = value + kBriefBits;
#if defined(__SSE4_2__)
  for (int i = 0; i < kBriefBits; i += 16) {
    const __m128i a = _mm_load_si128(reinterpret_cast<const __m128i*>(first + i));
    const __m128i b = _mm_load_si128(reinterpret_cast<const __m128i*>(second + i));
    const __m128i not_less = _mm_cmpeq_epi8(_mm_max_epu8(a, b), a);
    const auto less = static_cast<std::uint16_t>(~_mm_movemask_epi8(not_less));
    __builtin_memcpy(bits + i / 8, &less, sizeof less);
  }
#else
  for (int i = 0; i < kBriefBits; i += 8) {
    unsigned byte = 0;
    for (int j = 0; j < 8; ++j) byte |= static_cast<unsigned>(first[i + j] < second[i + j]) << j;
    bits[i / 8] = static_cast<std::uint8_t>(byte);
  }
#endif
#endif
}

}  // namespace

extern const OrbKernels kOrbKernels;
const OrbKernels kOrbKernels{moments, brief};

}  // namespace cairn::CAIRN_ISA
