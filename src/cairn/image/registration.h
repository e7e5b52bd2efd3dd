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
/// become the colour camera's. 0 where nothing fell. The span follows focal lengths, distortion and rotation
/// of the cameras, so that a surface that faces them has no holes.
class DepthRegistration {
 public:
  DepthRegistration(const Camera& depth_camera, const Camera& color_camera, const Rigid3& camera_from_depth);
  [[nodiscard]] DepthImage operator()(const DepthImage& depth) const;

 private:
  /// What one depth pixel is to the colour camera.
  struct PixelRay {
    Eigen::Vector3d rotated;    // R * (x/z, y/z, 1); NaN where there is none
    Eigen::Vector2d half_span;  // colour pixels, half the depth pixel's extent at equal distance
  };

  void cast_rays(const Eigen::Matrix3d& rotation);
  void measure_spans();
  void splat(DepthImage& registered, const PixelRay& ray, double depth) const;

  Camera depth_camera_;
  Camera color_camera_;
  Eigen::Vector3d translation_;
  std::vector<PixelRay> rays_;  // row by row
};

}  // namespace cairn
