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

/// Depth seen by the depth camera, moved into the colour camera's pixels: each depth pixel's centre is
/// projected, covers as many colour pixels as it spans there, and the nearest surface wins (z-buffer). Depths
/// become the colour camera's. 0 where nothing fell.
class DepthRegistration {
 public:
  DepthRegistration(const Camera& depth_camera, const Camera& color_camera, const Rigid3& camera_from_depth);
  [[nodiscard]] DepthImage operator()(const DepthImage& depth) const;

 private:
  void splat(DepthImage& registered, const Eigen::Vector3d& rotated_ray, double depth) const;

  Camera depth_camera_;
  Camera color_camera_;
  Eigen::Vector3d translation_;
  Eigen::Vector2d magnification_;  // colour pixels per depth pixel, at equal distance
  std::vector<Eigen::Vector3d>
      rotated_rays_;  // R * (x/z, y/z, 1) of each depth pixel; NaN where there is none
};

}  // namespace cairn
