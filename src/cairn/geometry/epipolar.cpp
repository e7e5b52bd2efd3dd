// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/epipolar.h"

#include <Eigen/Geometry>
#include <cmath>

namespace cairn {

double epipolar_distance(const Rig& rig, const Rigid3& b_from_a, const Eigen::Vector2d& pixel_a,
                         const Eigen::Vector2d& pixel_b) {
  const Eigen::Vector3d line =
      b_from_a.translation.cross(b_from_a.rotation * rig.point_at(pixel_a.x(), pixel_a.y(), 1));
  const double by_u = line.x() / rig.fx, by_v = line.y() / rig.fy;
  const double at_pixel = by_u * (pixel_b.x() - rig.cx) + by_v * (pixel_b.y() - rig.cy) + line.z();
  return std::abs(at_pixel) / std::hypot(by_u, by_v);
}

}  // namespace cairn
