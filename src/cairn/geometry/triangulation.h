// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Describes a point seen by two cameras.
struct TriangulatedPoint {
  Eigen::Vector3d point_in_a;  ///< in the first camera's frame, in the unit of the translation
  double angle = 0;            ///< between the two rays, radians
  double squared_error = 0;    ///< squared error of (x/z, y/z), summed over both views
};

/// Computes the point with the least squared distance from its two images `a` and `b`, both (x/z, y/z): the
/// linear solution of a x X = 0 and b x (R X + t) = 0 (Hartley and Zisserman 2004, sec. 12.2, inhomogeneous),
/// then Gauss-Newton steps on the four coordinates. Its unit is that of b_from_a's translation. Returns
/// nullopt if the rays meet behind a camera or at an angle below `min_angle` radians, at which the depth is
/// not determined.
[[nodiscard]] std::optional<TriangulatedPoint> triangulate(const Rigid3& b_from_a, const Eigen::Vector2d& a,
                                                           const Eigen::Vector2d& b, double min_angle);

}  // namespace cairn
