// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "cairn/geometry/framed.h"

namespace cairn {

/// How a world seen from above lies in a picture: unit vectors in the world, orthogonal, of which right x up
/// points to the viewer.
struct PlanAxes {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
  std::string right_name = "x", up_name = "y";  ///< of the world's axes; empty if they are none of these
};

/// Chooses the axes. A georeferenced world has north up. Of any other one, above is where the cameras' up
/// vectors point on average: along the axis of the world that is nearest to it, within 25 degrees, else along
/// itself. Then x is to the right (y if x points upwards): in the world of a SLAM run, where y points down, z
/// is up in the picture.
[[nodiscard]] PlanAxes choose_plan_axes(bool georeferenced, std::span<const WorldFromCamera> poses);

/// A rectangle of the plane, metres from `PlanView::origin`.
struct PlanRange {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();

  void include(const Eigen::Vector2d& place) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
};

/// Where the plane lies in a picture.
struct PlanView {
  PlanAxes axes;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< in the world, metres
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the range, metres from the origin
  double pixels_per_metre = 1;
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< pixels, upper left of the drawing
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    ///< of the drawing, pixels

  /// Metres to the right and up.
  [[nodiscard]] Eigen::Vector2d metres(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector3d away = point_in_world - origin;
    return {axes.right.dot(away), axes.up.dot(away)};
  }
  /// Pixels.
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector3d& point_in_world) const {
    const Eigen::Vector2d away = pixels_per_metre * (metres(point_in_world) - centre);
    return corner + 0.5 * size + Eigen::Vector2d(away.x(), -away.y());
  }
};

/// Limits of a drawing, pixels.
struct PlanSize {
  Eigen::Vector2d least{900, 420}, most{1500, 1100};
};

/// Sets centre, scale and size of the drawing: as large as it may be, and no larger than the range needs.
void fit_plan(const PlanRange& range, const PlanSize& limits, PlanView& view);

}  // namespace cairn
