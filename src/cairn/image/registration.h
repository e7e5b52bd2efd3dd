// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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
  struct Footprint {
    int u_begin, u_end, v_begin, v_end;
  };
  [[nodiscard]] std::optional<Eigen::Vector2d> color_pixel(const Eigen::Vector3d& rotated_ray,
                                                           double depth) const;
  [[nodiscard]] std::optional<Footprint> footprint(std::size_t upper_left, double depth) const;

  Camera depth_camera_;
  Camera color_camera_;
  Eigen::Vector3d translation_;
  // R * (x/z, y/z, 1) of each depth pixel's upper left corner, one more per row and column.
  std::vector<Eigen::Vector3d> rotated_rays_;
};

}  // namespace cairn
