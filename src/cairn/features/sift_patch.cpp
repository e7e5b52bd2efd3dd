// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/features/kernels/patch_kernels.h"

namespace cairn {

namespace {

/// The level whose smoothing is nearest to a point's, and the point in its pixels.
struct PointInLevel {
  const ScaleLevel& level;
  float x, y;
  double sigma;
};

/// The coarse levels of an octave are in the next one, too, where they take a quarter of the memory to read.
PointInLevel see(const ScaleSpace& space, const ScalePoint& point) {
  const int level = static_cast<int>(std::lround(point.level));
  const double sigma = space.sigma(static_cast<double>(point.level));
  if (level < space.layers() || point.octave + 1 == space.octave_count())
    return {space.level(point.octave, level), point.x, point.y, sigma};
  return {space.level(point.octave + 1, level - space.layers()), point.x / 2, point.y / 2, sigma / 2};
}

}  // namespace

void sample_patch(const ScaleSpace& space, const ScalePoint& point, const Patch& patch, float* samples) {
  const PointInLevel seen = see(space, point);
  const double angle = patch.angle_deg * std::numbers::pi / 180, step = patch.step * seen.sigma;
  const PatchGrid grid{seen.level.pixels,
                       seen.level.width,
                       seen.level.height,
                       seen.level.stride,
                       seen.x,
                       seen.y,
                       static_cast<float>(step * std::cos(angle)),
                       static_cast<float>(step * std::sin(angle)),
                       static_cast<float>(patch.gradients) / 2};
  patch_kernels().sample(grid, patch.side, samples);
}

void prefetch_patch(const ScaleSpace& space, const ScalePoint& point, double reach) {
  constexpr int kCacheLine = 16;  // floats
  constexpr int kSecondCache = 2;
  const PointInLevel seen = see(space, point);
  const auto radius = static_cast<float>(reach * seen.sigma);
  const int left = std::max(0, static_cast<int>(seen.x - radius)) / kCacheLine * kCacheLine;
  const int right = std::min(seen.level.width - 1, static_cast<int>(seen.x + radius));
  const int bottom = std::min(seen.level.height - 1, static_cast<int>(seen.y + radius));
  for (int v = std::max(0, static_cast<int>(seen.y - radius)); v <= bottom; ++v)
    for (int u = left; u <= right; u += kCacheLine)
      __builtin_prefetch(seen.level.row(v) + u, 0, kSecondCache);
}

}  // namespace cairn
