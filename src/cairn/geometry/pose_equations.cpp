// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pose_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

bool usable(const Observation& seen) {
  return std::isfinite(seen.u) && std::isfinite(seen.v) && seen.sigma_px > 0;
}

}  // namespace

void require_observations(std::span<const Eigen::Vector3d> points_in_world,
                          std::span<const Observation> seen) {
  require(std::all_of(seen.begin(), seen.end(), usable), "pixels are finite");
  require(std::all_of(points_in_world.begin(), points_in_world.end(),
                      [](const Eigen::Vector3d& point) { return point.allFinite(); }),
          "points are finite");
}

Eigen::Matrix<double, 3, 6> observation_jacobian(const Rig& rig, const Eigen::Vector3d& point_in_camera) {
  const double inverse_depth = 1.0 / point_in_camera.z();
  const double x = point_in_camera.x() * inverse_depth, y = point_in_camera.y() * inverse_depth;
  Eigen::Matrix3d by_point;  // d(u, v, d) / d(x, y, z)
  by_point << rig.fx, 0, -rig.fx * x, 0, rig.fy, -rig.fy * y, 0, 0, -rig.fx * rig.baseline * inverse_depth;
  by_point *= inverse_depth;
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -by_point * skew(point_in_camera), by_point;
  return jacobian;
}

void PoseEquations::add(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen,
                        double weight) {
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  const Eigen::Vector3d error(projected.x() - seen.u, projected.y() - seen.v,
                              seen.has_disparity() ? projected.z() - seen.d : 0.0);
  const double pixel_weight = weight / (seen.sigma_px * seen.sigma_px);
  const double disparity_weight = seen.has_disparity() ? weight / (seen.sigma_d_px * seen.sigma_d_px) : 0.0;
  const Eigen::Vector3d weights(pixel_weight, pixel_weight, disparity_weight);
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
