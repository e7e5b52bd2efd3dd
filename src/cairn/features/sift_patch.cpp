// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/features/kernels/patch_kernels.h"

namespace cairn {

void sample_patch(const ScaleSpace& space, const ScalePoint& point, const Patch& patch, float* samples) {
  const double angle = patch.angle_deg * std::numbers::pi / 180;
  const double pixels = patch.step * space.sigma(static_cast<double>(point.level));
  const ScaleLevel& level = space.level(point.octave, static_cast<int>(std::lround(point.level)));
  const PatchGrid grid{level.pixels,
                       level.width,
                       level.height,
                       level.stride,
                       point.x,
                       point.y,
                       static_cast<float>(pixels * std::cos(angle)),
                       static_cast<float>(pixels * std::sin(angle)),
                       static_cast<float>(patch.gradients) / 2};
  patch_kernels().sample(grid, patch.side, samples);
}

void prefetch_patch(const ScaleSpace& space, const ScalePoint& point) {
  constexpr double kReach = 7.5;  // sigmas, half the side of a descriptor's patch
  constexpr int kLine = 16;       // floats in a cache line
  const ScaleLevel& level = space.level(point.octave, static_cast<int>(std::lround(point.level)));
  const int reach = static_cast<int>(kReach * space.sigma(static_cast<double>(point.level)));
  const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
  const int left = std::max(0, x - reach), right = std::min(level.width - 1, x + reach);
  for (int v = std::max(0, y - reach); v <= std::min(level.height - 1, y + reach); ++v)
    for (int u = left / kLine * kLine; u <= right; u += kLine) __builtin_prefetch(level.row(v) + u);
}

}  // namespace cairn
