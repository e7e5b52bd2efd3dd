// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/patch_kernels.h"

#include "cairn/simd/float_lanes.h"

namespace cairn::CAIRN_ISA {
namespace {

constexpr int kBlock = 16;  // what one round of a loop works on, whatever the width of vectors
constexpr int kDirections = 8;
constexpr int kCells = 4;

/// Where 16 samples lie: the pixel up and left of each, and the fractions to its right and below.
struct Places {
  int offset[kBlock];
  float right[kBlock], below[kBlock];
};

/// Of columns [begin, begin + 16) of the grid's row i.
Places places_of(const PatchGrid& grid, int i, int begin) {
  const float down = static_cast<float>(i) - grid.middle, along = static_cast<float>(begin) - grid.middle;
  const float max_x = static_cast<float>(grid.width - 1), max_y = static_cast<float>(grid.height - 1);
  const float first_x = grid.x + along * grid.ux - down * grid.uy;
  const float first_y = grid.y + along * grid.uy + down * grid.ux;
  Places places;
  for (int j = 0; j < kBlock; ++j) {
    float x = first_x + static_cast<float>(j) * grid.ux, y = first_y + static_cast<float>(j) * grid.uy;
    x = x < 0.0F ? 0.0F : x;
    y = y < 0.0F ? 0.0F : y;
    x = x > max_x ? max_x : x;
    y = y > max_y ? max_y : y;
    int column = static_cast<int>(x), row = static_cast<int>(y);
    column = column > grid.width - 2 ? grid.width - 2 : column;
    row = row > grid.height - 2 ? grid.height - 2 : row;
    places.right[j] = x - static_cast<float>(column);
    places.below[j] = y - static_cast<float>(row);
    places.offset[j] = row * grid.stride + column;
  }
  return places;
}

/// The pixels left and right of four places: two of them beside each other are read at once.
struct Pairs {
  float left[4], right[4];
};

#if defined(__SSE2__)
inline Pairs pairs_at(const float* pixels, const int* offsets) {
  const auto pair = [&](int j) { return reinterpret_cast<const __m64*>(pixels + offsets[j]); };
  const __m128 first = _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), pair(0)), pair(1));
  const __m128 second = _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), pair(2)), pair(3));
  Pairs pairs;
  _mm_storeu_ps(pairs.left, _mm_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0)));
  _mm_storeu_ps(pairs.right, _mm_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1)));
  return pairs;
}
#else
inline Pairs pairs_at(const float* pixels, const int* offsets) {
  Pairs pairs;
  for (int j = 0; j < 4; ++j) {
    pairs.left[j] = pixels[offsets[j]];
    pairs.right[j] = pixels[offsets[j] + 1];
  }
  return pairs;
}
#endif

/// Blends the four pixels around each place, columns first.
void blend(const float* pixels, int stride, const Places& places, float* samples) {
  for (int j = 0; j < kBlock; j += 4) {
    const Pairs above = pairs_at(pixels, places.offset + j),
                under = pairs_at(pixels + stride, places.offset + j);
    for (int l = 0; l < 4; ++l) {
      const float left = above.left[l] + places.below[j + l] * (under.left[l] - above.left[l]);
      const float right = above.right[l] + places.below[j + l] * (under.right[l] - above.right[l]);
      samples[j + l] = left + places.right[j + l] * (right - left);
    }
  }
}

void sample(const PatchGrid& grid, int side, float* samples) {
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; j += kBlock)
      blend(grid.pixels, grid.stride, places_of(grid, i, j), samples + i * side + j);
}

/// Twice the gradient amid four samples.
struct Gradient {
  Lanes x, y;
};

Gradient gradient_at(const float* samples, int side) {
  const Lanes a = load(samples), b = load(samples + 1), c = load(samples + side),
              d = load(samples + side + 1);
  const Lanes main = d - a, other = b - c;
  return {main + other, main - other};
}

/// atan(a) for a in [0, 1] to 1e-5 (Abramowitz and Stegun, 4.4.47), in bins.
Lanes small_angle(Lanes a) {
  constexpr float kBins = kOrientationBins * 0.15915494F;  // bins per radian
  const Lanes s = a * a;
  return broadcast(kBins) * a *
         (broadcast(0.9998660F) +
          s * (broadcast(-0.3302995F) +
               s * (broadcast(0.1801410F) + s * (broadcast(-0.0851330F) + s * broadcast(0.0208351F)))));
}

/// Direction of the gradient in bins, [0, kOrientationBins].
Lanes direction_of(const Gradient& gradient) {
  const Lanes zero = broadcast(0.0F);
  const Lanes ax = larger(gradient.x, zero - gradient.x), ay = larger(gradient.y, zero - gradient.y);
  constexpr float kTiny = 1e-20F;  // instead of a division by zero
  const Lanes angle = small_angle(smaller(ax, ay) / larger(larger(ax, ay), broadcast(kTiny)));
  const Lanes first = choose(ay, ax, broadcast(kOrientationBins / 4.0F) - angle, angle);
  const Lanes upper = choose(zero, gradient.x, broadcast(kOrientationBins / 2.0F) - first, first);
  return choose(zero, gradient.y, broadcast(kOrientationBins) - upper, upper);
}

/// Bin of each direction in a row of gradients, and their lengths times their weights.
void bins_of(const float* samples, const float* weights, int* bins, float* lengths) {
  for (int j = 0; j < kBlock; j += kLanes) {
    const Gradient gradient = gradient_at(samples + j, kOrientationSide);
    const Lanes length = square_root(gradient.x * gradient.x + gradient.y * gradient.y);
    store(lengths + j, load(weights + j) * length);
    store_truncated(bins + j, direction_of(gradient) + broadcast(0.5F));
  }
}

void orientations(const float* samples, const float* weights, float* histogram) {
  // Neighbours often fall into one bin; sums of their own need not wait for each other.
  constexpr int kSums = 4;
  float sums[kSums][kOrientationBins + 1] = {};
  for (int i = 0; i + 1 < kOrientationSide; ++i) {
    float lengths[kBlock];
    int bins[kBlock];
    bins_of(samples + i * kOrientationSide, weights + i * kOrientationSide, bins, lengths);
    for (int j = 0; j < kBlock; ++j) sums[j % kSums][bins[j]] += lengths[j];
  }
  for (int b = 0; b < kOrientationBins; ++b)
    histogram[b] = (sums[0][b] + sums[1][b]) + (sums[2][b] + sums[3][b]);
  histogram[0] += (sums[0][kOrientationBins] + sums[1][kOrientationBins]) +
                  (sums[2][kOrientationBins] + sums[3][kOrientationBins]);
}

/// Shares of a gradient in 8 directions: it is written as the sum of two vectors, one along the nearer axis
/// and one along the nearer diagonal, whose lengths are these, the latter over the square root of 2. Like
/// Lowe's linear interpolation between neighbouring bins it is continuous and falls to zero one bin away, and
/// needs no angle.
void split(const Gradient& gradient, Lanes* shares) {
  const Lanes zero = broadcast(0.0F);
  const Lanes minus_x = zero - gradient.x, minus_y = zero - gradient.y;
  const Lanes ax = larger(gradient.x, minus_x), ay = larger(gradient.y, minus_y);
  const Lanes right = larger(gradient.x, zero), left = larger(minus_x, zero);
  const Lanes down = larger(gradient.y, zero), up = larger(minus_y, zero);
  shares[0] = larger(gradient.x - ay, zero);
  shares[1] = smaller(right, down);
  shares[2] = larger(gradient.y - ax, zero);
  shares[3] = smaller(left, down);
  shares[4] = larger(minus_x - ay, zero);
  shares[5] = smaller(left, up);
  shares[6] = larger(minus_y - ax, zero);
  shares[7] = smaller(right, up);
}

/// Sums over rows: pooled[cell row][direction][column].
using Pooled = float[kCells][kDirections][kDescriptorSide];

/// Columns [x, x + kLanes): each of the five bands of kCellSteps rows belongs to the cells above and below.
void pool_rows(const float* samples, const CellWeights& weights, int x, Pooled& pooled) {
  Lanes upper[kDirections], lower[kDirections];
  for (Lanes& sum : lower) sum = broadcast(0.0F);
  for (int band = 0; band <= kCells; ++band) {
    for (int d = 0; d < kDirections; ++d) {
      upper[d] = lower[d];
      lower[d] = broadcast(0.0F);
    }
    for (int k = 0; k < kCellSteps; ++k) {
      Lanes shares[kDirections];
      split(gradient_at(samples + (band * kCellSteps + k) * kDescriptorSide + x, kDescriptorSide), shares);
      const Lanes above = broadcast(band > 0 ? weights.weights[band - 1][kCellSteps + k] : 0.0F);
      const Lanes below = broadcast(band < kCells ? weights.weights[band][k] : 0.0F);
      for (int d = 0; d < kDirections; ++d) {
        upper[d] = upper[d] + above * shares[d];
        lower[d] = lower[d] + below * shares[d];
      }
    }
    if (band == 0) continue;
    for (int d = 0; d < kDirections; ++d) store(pooled[band - 1][d] + x, upper[d]);
  }
}

void pool_columns(const Pooled& pooled, const CellWeights& weights, float* values) {
  constexpr float kDiagonal = 1.41421356F;
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      for (int d = 0; d < kDirections; ++d) {
        float sum = 0;
        for (int k = 0; k < 2 * kCellSteps; ++k)
          sum += weights.weights[column][k] * pooled[row][d][column * kCellSteps + k];
        *values++ = d % 2 == 0 ? sum : kDiagonal * sum;
      }
    }
  }
}

/// Of kBlock sums.
float sum_of(float* sums) {
  for (int half = kBlock / 2; half > 0; half /= 2)
    for (int l = 0; l < half; ++l) sums[l] += sums[l + half];
  return sums[0];
}

float length_of(const float* values) {
  float sums[kBlock] = {};
  for (int i = 0; i < kDescriptorBytes; i += kBlock)
    for (int l = 0; l < kBlock; ++l) sums[l] += values[i + l] * values[i + l];
  return __builtin_sqrtf(sum_of(sums));
}

/// Shares of the sum, and their square roots (Arandjelovic and Zisserman 2012), of length 1.
void take_roots(float* values) {
  float sums[kBlock] = {};
  for (int i = 0; i < kDescriptorBytes; i += kBlock)
    for (int l = 0; l < kBlock; ++l) sums[l] += values[i + l];
  const float sum = sum_of(sums), scale = sum > 0.0F ? 1.0F / sum : 0.0F;
  for (int i = 0; i < kDescriptorBytes; ++i) values[i] = __builtin_sqrtf(values[i] * scale);
}

void to_bytes(float* values, bool root, std::uint8_t* bytes) {
  constexpr float kLargestShare = 0.2F, kFactor = 512.0F;  // Lowe 2004, section 6.1, and his program
  const float limit = kLargestShare * length_of(values);
  for (int i = 0; i < kDescriptorBytes; ++i) values[i] = values[i] > limit ? limit : values[i];
  if (root) take_roots(values);
  const float length = length_of(values), scale = length > 0.0F ? kFactor / length : 0.0F;
  for (int i = 0; i < kDescriptorBytes; ++i) {
    const float value = values[i] * scale + 0.5F;
    bytes[i] = static_cast<std::uint8_t>(static_cast<int>(value > 255.0F ? 255.0F : value));
  }
}

void describe(const float* samples, const CellWeights& weights, bool root, std::uint8_t* descriptor) {
  Pooled pooled;
  for (int x = 0; x < kDescriptorSide; x += kLanes) pool_rows(samples, weights, x, pooled);
  float values[kDescriptorBytes];
  pool_columns(pooled, weights, values);
  to_bytes(values, root, descriptor);
}

}  // namespace

extern const PatchKernels kPatchKernels;
const PatchKernels kPatchKernels{sample, orientations, describe};

}  // namespace cairn::CAIRN_ISA
