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

Eigen::Matrix3d innovation_covariance(const Rig& rig, const Eigen::Matrix3d& camera_from_world,
                                      const Eigen::Vector3d& point_in_camera, const Observation& seen,
                                      const Eigen::Matrix3d& point_covariance) {
  const Eigen::Matrix3d by_world = rig.projection_jacobian(point_in_camera) * camera_from_world;
  Eigen::Matrix3d covariance = by_world * point_covariance * by_world.transpose();
  const double of_pixel = seen.sigma_px * seen.sigma_px;
  covariance.diagonal() += Eigen::Vector3d(of_pixel, of_pixel, seen.sigma_d_px * seen.sigma_d_px);
  if (!seen.has_disparity()) {  // the third equation is none
    covariance.row(2).setZero();
    covariance.col(2).setZero();
    covariance(2, 2) = 1;
  }
  return covariance;
}

namespace {

WhitenedError unwhitened(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen) {
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  WhitenedError plain{{projected.x() - seen.u, projected.y() - seen.v, 0},
                      observation_jacobian(rig, point_in_camera)};
  if (seen.has_disparity())
    plain.error.z() = projected.z() - seen.d;
  else
    plain.jacobian.row(2).setZero();
  return plain;
}

}  // namespace

WhitenedError whiten(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen) {
  WhitenedError whitened = unwhitened(rig, point_in_camera, seen);
  const Eigen::Vector3d scale(1 / seen.sigma_px, 1 / seen.sigma_px,
                              seen.has_disparity() ? 1 / seen.sigma_d_px : 0.0);
  whitened.error.array() *= scale.array();
  whitened.jacobian.array().colwise() *= scale.array();
  return whitened;
}

WhitenedError whiten(const Rig& rig, const CameraFromWorld& camera_from_world,
                     const Eigen::Vector3d& point_in_world, const Observation& seen,
                     const Eigen::Matrix3d& point_covariance) {
  const Eigen::Vector3d point = camera_from_world * point_in_world;
  WhitenedError whitened = unwhitened(rig, point, seen);
  const Eigen::LLT<Eigen::Matrix3d> factor(
      innovation_covariance(rig, camera_from_world.matrix3(), point, seen, point_covariance));
  factor.matrixL().solveInPlace(whitened.error);
  factor.matrixL().solveInPlace(whitened.jacobian);
  return whitened;
}

void PoseEquations::add(const WhitenedError& whitened, double weight) {
  hessian.noalias() += weight * whitened.jacobian.transpose() * whitened.jacobian;
  gradient.noalias() += weight * whitened.jacobian.transpose() * whitened.error;
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
