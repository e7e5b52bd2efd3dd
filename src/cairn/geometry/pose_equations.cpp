// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pose_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {

bool is_usable(const Observation& seen) {
  return std::isfinite(seen.u) && std::isfinite(seen.v) && seen.sigma_px > 0 &&
         (!seen.has_disparity() || (std::isfinite(seen.d) && seen.sigma_d_px > 0));
}

void require_observations(std::span<const Eigen::Vector3d> points_in_world,
                          std::span<const Observation> seen) {
  require(std::all_of(seen.begin(), seen.end(), is_usable), "pixels are finite and sigmas above 0");
  require(std::all_of(points_in_world.begin(), points_in_world.end(),
                      [](const Eigen::Vector3d& point) { return point.allFinite(); }),
          "points are finite");
}

Eigen::Matrix<double, 3, 6> observation_jacobian(const Rig& rig, const Eigen::Vector3d& point_in_camera) {
  const Eigen::Matrix3d by_point = rig.projection_jacobian(point_in_camera);
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -by_point * skew(point_in_camera), by_point;
  return jacobian;
}

void PoseEquations::add(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen,
                        double weight) {
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  const Eigen::Vector3d error(projected.x() - seen.u, projected.y() - seen.v,
                              seen.has_disparity() ? projected.z() - seen.d : 0.0);
  const Eigen::Vector3d weights = weight * inverse_variances(seen);
  const Eigen::Matrix<double, 3, 6> jacobian = observation_jacobian(rig, point_in_camera);
  hessian.noalias() += jacobian.transpose() * weights.asDiagonal() * jacobian;
  gradient.noalias() += jacobian.transpose() * weights.cwiseProduct(error);
}

std::optional<Vector6d> PoseEquations::solve() const {
  const Eigen::LDLT<Matrix6d> factor(hessian);
  constexpr double kSmallestPivot = 1e-9;
  const auto pivots = factor.vectorD();
  if (factor.info() != Eigen::Success || pivots.minCoeff() <= kSmallestPivot * pivots.maxCoeff())
    return std::nullopt;
  const Vector6d step = -factor.solve(gradient);
  if (!step.allFinite()) return std::nullopt;
  return step;
}

}  // namespace cairn
