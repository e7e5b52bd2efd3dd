// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"

namespace cairn {

/// Holds a plane normal . point = distance, in the camera's frame, metres.
struct Plane {
  Eigen::Vector3d normal;  ///< unit, away from the camera
  double distance = 0;     ///< of the camera's centre, above 0

  /// Computes by how much a point lies behind the plane, metres; below 0 in front of it.
  [[nodiscard]] double behind(const Eigen::Vector3d& point) const { return normal.dot(point) - distance; }
};

/// Sets how planes are found in a depth image.
struct SurfaceOptions {
  double units_per_metre = 256;  ///< of the stored depth
  /// Half the side of the square of pixels to which planes are fitted: rounding of depths to 1/256 m turns a
  /// plane of 13 x 13 pixels at 5 m by about a hundredth of a radian, one of 3 x 3 pixels by a quarter.
  int half_window = 6;
  /// Distance, pixels, within which a pixel of the plane must lie from the position asked for: a feature at
  /// an outline is found up to so far beside it.
  double reach_px = 3;
};

/// Finds the planes of the surfaces that an exact depth image shows around a position of the image, the
/// nearest in the image first: one on a surface, several where surfaces meet or one hides another, none where
/// nothing is (depth 0) or the position is outside. Surfaces are plane, as those of simulated worlds: a plane
/// is one if the depths of 8 pixels at least lie on it within a unit of the depth. `camera` is a pinhole.
[[nodiscard]] std::vector<Plane> find_surfaces(const RawDepthImage& depth, const Camera& camera,
                                               const Eigen::Vector2d& pixel,
                                               const SurfaceOptions& options = {});

}  // namespace cairn
