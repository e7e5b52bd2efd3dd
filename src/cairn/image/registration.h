// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn {

/// Converts stored depth to metres: raw / scale, 0 if raw is one of `invalid`. `scale` in units per metre;
/// throws PreconditionError unless it is above 0.
[[nodiscard]] DepthImage depth_in_metres(const RawDepthImage& raw, double scale,
                                         const std::vector<std::uint16_t>& invalid);

/// Registers depth to the colour camera: each depth pixel's centre is projected into the colour image, covers
/// as many colour pixels as it spans there, and the nearest surface wins (z-buffer). Depths become the colour
/// camera's, 0 if nothing falls on a pixel. The span follows focal lengths, distortion and rotation of the
/// cameras, so that a surface that faces them has no holes.
class DepthRegistration {
 public:
  DepthRegistration(const Camera& depth_camera, const Camera& color_camera, const Rigid3& camera_from_depth);
  /// Registers an image, metres. Throws PreconditionError unless it has the depth camera's size.
  [[nodiscard]] DepthImage operator()(const DepthImage& depth) const;

 private:
  /// Holds the rays of the depth pixels in the colour camera's axes, row by row.
  struct Rays {
    Eigen::ArrayXd x, y, z;         // R * (x/z, y/z, 1); NaN if there is none
    Eigen::ArrayXd half_u, half_v;  // colour pixels, half the depth pixel's extent at equal distance
  };
  /// Holds the colour pixels that one row of depth pixels covers.
  struct Row {
    Eigen::Index first_ray = 0;
    Eigen::ArrayXd depth;                           // metres, in the depth camera
    Eigen::ArrayXd z;                               // metres, in the colour camera
    Eigen::ArrayXd u, v;                            // centres, colour pixels; NaN if there is none
    Eigen::ArrayXd u_begin, u_end, v_begin, v_end;  // colour pixels that are covered, ends excluded
  };

  void cast_rays(const Eigen::Matrix3d& rotation);
  void measure_spans();
  void place(Row& row) const;
  void cover(Row& row) const;
  static void draw(const Row& row, DepthImage& registered);

  Camera depth_camera_;
  Camera color_camera_;
  Eigen::Vector3d translation_;
  Rays rays_;
};

}  // namespace cairn
