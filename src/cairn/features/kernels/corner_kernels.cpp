// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/corner_kernels.h"

#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

namespace cairn::CAIRN_ISA {
namespace {

constexpr int kRing = 16;
/// The circle of radius 3, clockwise from the top.
constexpr int kRingU[kRing] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
constexpr int kRingV[kRing] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};

struct Ring {
  std::ptrdiff_t offset[kRing];
};

Ring ring_of(std::ptrdiff_t stride) {
  Ring ring{};
  for (int i = 0; i < kRing; ++i) ring.offset[i] = kRingV[i] * stride + kRingU[i];
  return ring;
}

/// Whether 9 neighbours of the 16 bits are set, the 16th being beside the first.
bool has_arc(unsigned bits) {
  const unsigned twice = bits | bits << kRing;
  const unsigned two = twice & twice >> 1;
  const unsigned four = two & two >> 2;
  const unsigned eight = four & four >> 4;
  return (eight & twice >> 8) != 0;
}

bool is_corner(const std::uint8_t* pixel, const Ring& ring, int threshold) {
  const int high = *pixel + threshold, low = *pixel - threshold;
  unsigned brighter = 0, darker = 0;
  for (int i = 0; i < kRing; ++i) {
    const int value = pixel[ring.offset[i]];
    brighter |= static_cast<unsigned>(value > high) << i;
    darker |= static_cast<unsigned>(value < low) << i;
  }
  return has_arc(brighter) || has_arc(darker);
}

/// Many pixels at once: one bit or byte a pixel says whether a comparison holds there.
#if defined(__AVX512BW__)
struct Lanes {
  using Pixels = __m512i;
  using Flags = std::uint64_t;
  static constexpr int kCount = 64;
  static Pixels load(const std::uint8_t* p) { return _mm512_loadu_si512(p); }
  static Pixels fill(int value) { return _mm512_set1_epi8(static_cast<char>(value)); }
  static Pixels plus(Pixels a, Pixels b) { return _mm512_adds_epu8(a, b); }
  static Pixels minus(Pixels a, Pixels b) { return _mm512_subs_epu8(a, b); }
  static Flags above(Pixels a, Pixels b) { return _mm512_cmpgt_epu8_mask(a, b); }
  static Flags both(Flags a, Flags b) { return a & b; }
  static Flags either(Flags a, Flags b) { return a | b; }
  static std::uint64_t bits(Flags flags) { return flags; }
};
#elif defined(__AVX2__)
struct Lanes {
  using Pixels = __m256i;
  using Flags = __m256i;
  static constexpr int kCount = 32;
  static Pixels load(const std::uint8_t* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  static Pixels fill(int value) { return _mm256_set1_epi8(static_cast<char>(value)); }
  static Pixels plus(Pixels a, Pixels b) { return _mm256_adds_epu8(a, b); }
  static Pixels minus(Pixels a, Pixels b) { return _mm256_subs_epu8(a, b); }
  static Flags above(Pixels a, Pixels b) { return _mm256_subs_epu8(a, b); }  // not zero: above
  static Flags both(Flags a, Flags b) { return _mm256_min_epu8(a, b); }
  static Flags either(Flags a, Flags b) { return _mm256_or_si256(a, b); }
  static std::uint64_t bits(Flags flags) {
    const auto zero = _mm256_movemask_epi8(_mm256_cmpeq_epi8(flags, _mm256_setzero_si256()));
    return ~static_cast<std::uint32_t>(zero);
  }
};
#elif defined(__SSE4_2__)
struct Lanes {
  using Pixels = __m128i;
  using Flags = __m128i;
  static constexpr int kCount = 16;
  static Pixels load(const std::uint8_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
  static Pixels fill(int value) { return _mm_set1_epi8(static_cast<char>(value)); }
  static Pixels plus(Pixels a, Pixels b) { return _mm_adds_epu8(a, b); }
  static Pixels minus(Pixels a, Pixels b) { return _mm_subs_epu8(a, b); }
  static Flags above(Pixels a, Pixels b) { return _mm_subs_epu8(a, b); }  // not zero: above
  static Flags both(Flags a, Flags b) { return _mm_min_epu8(a, b); }
  static Flags either(Flags a, Flags b) { return _mm_or_si128(a, b); }
  static std::uint64_t bits(Flags flags) {
    const auto zero = _mm_movemask_epi8(_mm_cmpeq_epi8(flags, _mm_setzero_si128()));
    return ~static_cast<std::uint32_t>(zero) & 0xffffU;
  }
};
#endif

#if defined(__SSE4_2__)
/// Pixels with 9 neighbouring flags set around the ring.
Lanes::Flags arcs(const Lanes::Flags* flags) {
  Lanes::Flags two[kRing], four[kRing];
  for (int i = 0; i < kRing; ++i) two[i] = Lanes::both(flags[i], flags[(i + 1) % kRing]);
  for (int i = 0; i < kRing; ++i) four[i] = Lanes::both(two[i], two[(i + 2) % kRing]);
  Lanes::Flags any{};
  for (int i = 0; i < kRing; ++i) {
    const auto eight = Lanes::both(four[i], four[(i + 4) % kRing]);
    any = Lanes::either(any, Lanes::both(eight, flags[(i + 8) % kRing]));
  }
  return any;
}

/// Of 9 neighbours on the ring two are neighbours among its top, right, bottom and left.
Lanes::Flags two_of_cross(const Lanes::Flags* flags) {
  const auto right_half = Lanes::both(flags[4], Lanes::either(flags[0], flags[8]));
  const auto left_half = Lanes::both(flags[12], Lanes::either(flags[0], flags[8]));
  return Lanes::either(right_half, left_half);
}

/// One bit for each of kCount pixels.
std::uint64_t corners_of_block(const std::uint8_t* pixels, const Ring& ring, Lanes::Pixels threshold) {
  const auto centre = Lanes::load(pixels);
  const auto high = Lanes::plus(centre, threshold), low = Lanes::minus(centre, threshold);
  Lanes::Flags brighter[kRing], darker[kRing];
  const auto compare = [&](int i) {
    const auto value = Lanes::load(pixels + ring.offset[i]);
    brighter[i] = Lanes::above(value, high);
    darker[i] = Lanes::above(low, value);
  };
  for (int i = 0; i < kRing; i += 4) compare(i);
  if (Lanes::bits(Lanes::either(two_of_cross(brighter), two_of_cross(darker))) == 0) return 0;
  for (int i = 0; i < kRing; ++i)
    if (i % 4 != 0) compare(i);
  return Lanes::bits(Lanes::either(arcs(brighter), arcs(darker)));
}
#endif

int find_fast(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
              std::int32_t* found) {
  const Ring ring = ring_of(stride);
  int count = 0, u = begin;
#if defined(__SSE4_2__)
  const auto limit = Lanes::fill(threshold);
  for (; u + Lanes::kCount <= end; u += Lanes::kCount) {
    for (std::uint64_t bits = corners_of_block(row + u, ring, limit); bits != 0; bits &= bits - 1)
      found[count++] = u + __builtin_ctzll(bits);
  }
#endif
  for (; u < end; ++u)
    if (is_corner(row + u, ring, threshold)) found[count++] = u;
  return count;
}

int fast_score(const std::uint8_t* pixel, std::ptrdiff_t stride) {
  const Ring ring = ring_of(stride);
  std::int16_t d[2 * kRing];
  for (int i = 0; i < kRing; ++i)
    d[i] = d[i + kRing] = static_cast<std::int16_t>(pixel[ring.offset[i]] - *pixel);
  std::int16_t least[kRing], most[kRing];  // of the 9 from i on
  for (int i = 0; i < kRing; ++i) least[i] = most[i] = d[i];
  for (int k = 1; k <= 8; ++k) {
    for (int i = 0; i < kRing; ++i) {
      least[i] = d[i + k] < least[i] ? d[i + k] : least[i];
      most[i] = d[i + k] > most[i] ? d[i + k] : most[i];
    }
  }
  int best = 0;
  for (int i = 0; i < kRing; ++i) {
    const int bright = least[i], dark = -most[i];
    best = bright > best ? bright : best;
    best = dark > best ? dark : best;
  }
  return best > 0 ? best - 1 : 0;
}

void structure_tensor(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t sums[3]) {
  constexpr int kHalf = 3, kSide = 8;  // the eighth column weighs nothing: it fills the register
  std::int32_t xx[kSide]{}, xy[kSide]{}, yy[kSide]{};
  for (int v = -kHalf; v <= kHalf; ++v) {
    const std::uint8_t* above = pixel + (v - 1) * stride - kHalf;
    const std::uint8_t* row = above + stride;
    const std::uint8_t* below = row + stride;
    for (int i = 0; i < 2 * kHalf + 1; ++i) {
      const int dx =
          above[i + 1] - above[i - 1] + 2 * (row[i + 1] - row[i - 1]) + below[i + 1] - below[i - 1];
      const int dy = below[i - 1] + 2 * below[i] + below[i + 1] - above[i - 1] - 2 * above[i] - above[i + 1];
      xx[i] += dx * dx;
      xy[i] += dx * dy;
      yy[i] += dy * dy;
    }
  }
  sums[0] = sums[1] = sums[2] = 0;
  for (int i = 0; i < kSide; ++i) {
    sums[0] += xx[i];
    sums[1] += xy[i];
    sums[2] += yy[i];
  }
}

}  // namespace

extern const CornerKernels kCornerKernels;
const CornerKernels kCornerKernels{find_fast, fast_score, structure_tensor};

}  // namespace cairn::CAIRN_ISA
