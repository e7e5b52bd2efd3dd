// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/plan_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

constexpr std::array<const char*, 3> kNames{"x", "y", "z"}, kOppositeNames{"-x", "-y", "-z"};

Eigen::Vector3d mean_camera_up(std::span<const WorldFromCamera> poses) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const WorldFromCamera& pose : poses) sum -= pose.rotation * Eigen::Vector3d::UnitY();
  return sum.norm() > 1e-9 ? sum.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

/// Returns the name of an axis of the world: "-z" for (0, 0, -1).
std::string name_of(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return (direction[axis] < 0 ? kOppositeNames : kNames)[static_cast<std::size_t>(axis)];
}

}  // namespace

PlanAxes choose_plan_axes(bool georeferenced, std::span<const WorldFromCamera> poses) {
  constexpr double kMaxTilt = 25 * std::numbers::pi / 180;
  if (georeferenced) return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), "E", "N"};
  const Eigen::Vector3d camera_up = mean_camera_up(poses);
  Eigen::Index nearest = 0;
  const bool is_axis = camera_up.cwiseAbs().maxCoeff(&nearest) >= std::cos(kMaxTilt);
  Eigen::Vector3d above = camera_up;
  if (is_axis) above = std::copysign(1.0, camera_up[nearest]) * Eigen::Vector3d::Unit(nearest);
  Eigen::Vector3d right = nearest == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  right = (right - right.dot(above) * above).normalized();
  const Eigen::Vector3d up = above.cross(right);
  if (!is_axis) return {right, up, "", ""};
  return {right, up, name_of(right), name_of(up)};
}

void fit_plan(const PlanRange& range, const PlanSize& limits, PlanView& view) {
  constexpr double kMinRange = 0.1;  // metres: of a map that is one point
  constexpr double kMargin = 1.06;
  const Eigen::Vector2d needed = kMargin * (range.high - range.low).cwiseMax(kMinRange);
  view.centre = 0.5 * (range.low + range.high);
  view.pixels_per_metre = limits.most.cwiseQuotient(needed).minCoeff();
  view.size = (view.pixels_per_metre * needed).cwiseMax(limits.least).array().ceil();
}

}  // namespace cairn
