// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_patch.h"

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

}  // namespace cairn
