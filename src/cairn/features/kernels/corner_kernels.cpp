// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/corner_kernels.h"

#include "cairn/simd/byte_lanes.h"

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

/// The largest, over all 16 arcs of 9 neighbours, of the smallest difference in the arc. The arcs that begin
/// at i and i + 1 share 8 places: min(shared, max(d[i], d[i + 9])) is the better of the two.
template <class B>
[[gnu::always_inline]] inline B best_arc(const B* d) {
  B two[kRing], four[kRing];
  for (int i = 1; i < kRing; i += 2) two[i] = least(d[i], d[(i + 1) % kRing]);
  for (int i = 1; i < kRing; i += 2) four[i] = least(two[i], two[(i + 2) % kRing]);
  B best = B::fill(0);
  for (int i = 0; i < kRing; i += 2) {
    const B shared = least(four[i + 1], four[(i + 5) % kRing]);
    best = most(best, least(shared, most(d[i], d[(i + 9) % kRing])));
  }
  return best;
}

/// Tells whether any pixel may be a corner: of 9 neighbours on the ring, two are neighbours among its top,
/// right, bottom and left.
template <class B>
bool cross_differs(const B* d, B limit) {
  return least(most(d[0], d[8]), most(d[4], d[12])).not_below(limit) != 0;
}

/// Scores of B::kCount pixels; one is a corner with threshold t where its best arc differs by t + 1 or more.
template <class B>
[[gnu::always_inline]] inline B score_block(const std::uint8_t* pixels, const Ring& ring, B limit) {
  const B centre = B::load(pixels), none = B::fill(0);
  B brighter[kRing], darker[kRing];
  const auto compare = [&](int i) {
    const B value = B::load(pixels + ring.offset[i]);
    brighter[i] = minus(value, centre);
    darker[i] = minus(centre, value);
  };
  for (int i = 0; i < kRing; i += 4) compare(i);
  const bool may_be_brighter = cross_differs(brighter, limit), may_be_darker = cross_differs(darker, limit);
  if (!may_be_brighter && !may_be_darker) return none;
  for (int i = 0; i < kRing; ++i)
    if (i % 4 != 0) compare(i);
  const B best = most(may_be_brighter ? best_arc(brighter) : none, may_be_darker ? best_arc(darker) : none);
  return minus(best.cut_below(limit), B::fill(1));
}

/// Blocks of `B` that lie in [begin, end), and whether any score is above 0; moves `begin` to where they end.
template <class B>
bool score_blocks(const std::uint8_t* row, const Ring& ring, int& begin, int end, int threshold,
                  std::uint8_t* scores) {
  const B limit = B::fill(threshold + 1);
  B highest = B::fill(0);
  for (; begin + B::kCount <= end; begin += B::kCount) {
    const B block = score_block(row + begin, ring, limit);
    block.store(scores + begin);
    highest = most(highest, block);
  }
  return highest.not_below(B::fill(1)) != 0;
}

/// Fewer than a block's pixels: the block is computed whole, where the image has room for it, and the rest
/// dropped.
bool score_rest(const std::uint8_t* row, const Ring& ring, int width, int begin, int end, int threshold,
                std::uint8_t* scores) {
  constexpr int kReach = 3;
  const int room = width - kReach - Bytes::kCount;  // the last column where a block may begin
  if (room < kReach) return score_blocks<Byte>(row, ring, begin, end, threshold, scores);
  const int first = begin < room ? begin : room;
  std::uint8_t block[Bytes::kCount];
  const Bytes all = score_block(row + first, ring, Bytes::fill(threshold + 1));
  all.store(block);
  __builtin_memcpy(scores + begin, block + (begin - first), static_cast<std::size_t>(end - begin));
  const std::uint64_t wanted = ((std::uint64_t{1} << (end - begin)) - 1) << (begin - first);
  return (all.not_below(Bytes::fill(1)) & wanted) != 0;
}

bool score_fast(const std::uint8_t* row, std::ptrdiff_t stride, int width, int begin, int end, int threshold,
                std::uint8_t* scores) {
  const Ring ring = ring_of(stride);
  bool any = score_blocks<Bytes>(row, ring, begin, end, threshold, scores);
  if (begin < end) any = score_rest(row, ring, width, begin, end, threshold, scores) || any;
  return any;
}

/// One bit for each of B::kCount pixels that is a peak.
template <class B>
std::uint64_t peaks_of_block(const std::uint8_t* scores, std::ptrdiff_t stride) {
  const B score = B::load(scores), one = B::fill(1);
  if (score.not_below(one) == 0) return 0;
  const std::uint8_t *above = scores - stride, *below = scores + stride;
  const B before =
      most(most(B::load(above - 1), B::load(above)), most(B::load(above + 1), B::load(scores - 1)));
  const B after =
      most(most(B::load(below - 1), B::load(below)), most(B::load(below + 1), B::load(scores + 1)));
  return minus(score, before).not_below(one) & score.not_below(after);
}

int find_peaks(const std::uint8_t* scores, std::ptrdiff_t stride, int begin, int end, std::int32_t* found) {
  int count = 0;
  for (int u = begin; u < end; u += Bytes::kCount) {
    std::uint64_t bits = peaks_of_block<Bytes>(scores + u, stride);
    if (end - u < Bytes::kCount) bits &= (std::uint64_t{1} << (end - u)) - 1;
    for (; bits != 0; bits &= bits - 1) found[count++] = u + __builtin_ctzll(bits);
  }
  return count;
}

[[maybe_unused]] constexpr int kTensorHalf = 3, kTensorSide = 2 * kTensorHalf + 1;

#if defined(__SSE4_2__)
/// Eight pixels of a row smoothed (1 2 1) and differentiated (-1 0 1) along the row.
struct SobelRow {
  __m128i smooth, difference;
};

SobelRow sobel_row(const std::uint8_t* pixels) {
  const auto eight = [pixels](int shift) {
    return _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(pixels + shift)));
  };
  const __m128i left = eight(-1), middle = eight(0), right = eight(1);
  return {_mm_add_epi16(_mm_add_epi16(left, right), _mm_slli_epi16(middle, 1)), _mm_sub_epi16(right, left)};
}

std::int32_t sum_of(__m128i v) {
  const __m128i two = _mm_add_epi32(v, _mm_shuffle_epi32(v, 0x4e));
  return _mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 0xb1)));
}

void structure_tensor(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* sums) {
  const __m128i seven = _mm_srli_si128(_mm_set1_epi16(-1), 2);  // the eighth column is none of the window's
  const std::uint8_t* top_left = pixel - (kTensorHalf + 1) * stride - kTensorHalf;
  SobelRow above = sobel_row(top_left), row = sobel_row(top_left + stride);
  __m128i xx = _mm_setzero_si128(), xy = xx, yy = xx;
  for (int v = 0; v < kTensorSide; ++v) {
    const SobelRow below = sobel_row(top_left + (v + 2) * stride);
    const __m128i outer = _mm_add_epi16(above.difference, below.difference);
    const __m128i dx = _mm_and_si128(_mm_add_epi16(outer, _mm_slli_epi16(row.difference, 1)), seven);
    const __m128i dy = _mm_and_si128(_mm_sub_epi16(below.smooth, above.smooth), seven);
    xx = _mm_add_epi32(xx, _mm_madd_epi16(dx, dx));
    xy = _mm_add_epi32(xy, _mm_madd_epi16(dx, dy));
    yy = _mm_add_epi32(yy, _mm_madd_epi16(dy, dy));
    above = row;
    row = below;
  }
  sums[0] = sum_of(xx);
  sums[1] = sum_of(xy);
  sums[2] = sum_of(yy);
}
#else
void structure_tensor(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* sums) {
  sums[0] = sums[1] = sums[2] = 0;
  for (int v = -kTensorHalf; v <= kTensorHalf; ++v) {
    const std::uint8_t* row = pixel + v * stride;
    const std::uint8_t *above = row - stride, *below = row + stride;
    for (int i = -kTensorHalf; i <= kTensorHalf; ++i) {
      const int dx =
          above[i + 1] - above[i - 1] + 2 * (row[i + 1] - row[i - 1]) + below[i + 1] - below[i - 1];
      const int dy = below[i - 1] + 2 * below[i] + below[i + 1] - above[i - 1] - 2 * above[i] - above[i + 1];
      sums[0] += dx * dx;
      sums[1] += dx * dy;
      sums[2] += dy * dy;
    }
  }
}
#endif

}  // namespace

extern const CornerKernels kCornerKernels;
const CornerKernels kCornerKernels{score_fast, find_peaks, structure_tensor};

}  // namespace cairn::CAIRN_ISA
