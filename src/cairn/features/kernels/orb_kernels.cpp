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
  std::int8_t u[kMomentRadius + 1][kDiscSide]{};
  std::int8_t inside[kMomentRadius + 1][kDiscSide]{};
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
  alignas(64) std::uint8_t value[2 * kBriefBits];
  for (int i = 0; i < 2 * kBriefBits; ++i) value[i] = pixel[offset[i]];
  const std::uint8_t *first = value, *second = value + kBriefBits;
#if defined(__AVX512BW__)
  for (int i = 0; i < kBriefBits; i += 64) {
    const std::uint64_t less =
        _mm512_cmplt_epu8_mask(_mm512_load_si512(first + i), _mm512_load_si512(second + i));
    __builtin_memcpy(bits + i / 8, &less, sizeof less);
  }
#elif defined(__SSE4_2__)
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
}

}  // namespace

extern const OrbKernels kOrbKernels;
const OrbKernels kOrbKernels{moments, brief};

}  // namespace cairn::CAIRN_ISA
