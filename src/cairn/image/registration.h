// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn {

/// Stored depth to metres: raw / scale, 0 where raw is one of `invalid`. `scale` in units per metre, above 0.
[[nodiscard]] DepthImage depth_in_metres(const RawDepthImage& raw, double scale,
                                         const std::vector<std::uint16_t>& invalid);

/// Depth seen by the depth camera, moved into the colour camera's pixels: each depth pixel's footprint is
/// projected and the nearest surface wins (z-buffer). Depths become the colour camera's. 0 where nothing
/// fell.
class DepthRegistration {
 public:
  DepthRegistration(const Camera& depth_camera, const Camera& color_camera, const Rigid3& camera_from_depth);
  [[nodiscard]] DepthImage operator()(const DepthImage& depth) const;

 private:
  Camera depth_camera_;
  Camera color_camera_;
  Rigid3 camera_from_depth_;
  std::vector<Eigen::Vector2d>
      rays_;  // (x/z, y/z) of each depth pixel's upper left corner, one more per row and column
};

}  // namespace cairn
