// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "cairn/geometry/rig.h"

namespace cairn {

/// The residual's derivative by the left perturbation: rows du, dv, dd; columns rotation, translation.
/// Unweighted. With p the point in the camera, exp(w) p + v = p - [p]x w + v to first order, so it is the
/// projection's derivative by the point times (-[p]x, I) (Barfoot 2017, State Estimation for Robotics, sec.
/// 7.1.8 and 7.3).
[[nodiscard]] Eigen::Matrix<double, 3, 6> observation_jacobian(const Rig& rig,
                                                               const Eigen::Vector3d& point_in_camera);

/// Pixels and a disparity are finite and their sigmas above 0.
[[nodiscard]] bool is_usable(const Observation& seen);

/// PreconditionError unless the points are finite and the observations usable.
void require_observations(std::span<const Eigen::Vector3d> points_in_world,
                          std::span<const Observation> seen);

/// Normal equations of one camera's pose: J^T W J and J^T W e, summed over observations.
struct PoseEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();

  /// Adds one observation by its standard deviations, times `weight`. The point is in front of the camera.
  void add(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen, double weight);
  /// The Gauss-Newton step -(hessian)^-1 gradient; nothing where the observations do not determine the pose.
  [[nodiscard]] std::optional<Vector6d> solve() const;
};

}  // namespace cairn
