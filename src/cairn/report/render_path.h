// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/report/render.h"

namespace cairn {

/// Draws the path into a picture that was taken by `camera`: a line, blue at its beginning, orange at its
/// end, paler where it lies behind what is in `depth` (metres, 0 for nothing); keyframes as frustums.
void draw_camera_path(RgbImage& picture, const DepthImage& depth, const Camera& camera,
                      const Rigid3& camera_from_world, const CameraPath& path);

/// share 0: a, 1: b.
[[nodiscard]] Rgb8 blend(const Rgb8& a, const Rgb8& b, double share);

}  // namespace cairn
