// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/resection.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "cairn/geometry/covariance.h"
#include "cairn/geometry/pose_equations.h"
#include "cairn/optimize/robust_kernel.h"

namespace cairn {
namespace {

constexpr int kRounds = 4, kStepsPerRound = 6;
constexpr double kConvergedStep = 1e-8;  // radians and metres
constexpr double kHuber = 2.448;         // standard deviations: the root of the 95 % limit of (u, v)
constexpr std::size_t kFewest = 4;

struct Problem {
  const Rig& rig;
  std::span<const Sight> sights;
};

std::vector<std::int32_t> inliers_of(const Problem& problem, const CameraFromWorld& camera_from_world) {
  std::vector<std::int32_t> inliers;
  for (std::size_t i = 0; i < problem.sights.size(); ++i) {
    const Sight& sight = problem.sights[i];
    if (squared_innovation(problem.rig, camera_from_world, sight) < squared_error_limit(sight.seen))
      inliers.push_back(static_cast<std::int32_t>(i));
  }
  return inliers;
}

PoseEquations build(const Problem& problem, const std::vector<std::int32_t>& used,
                    const CameraFromWorld& camera_from_world, double huber) {
  PoseEquations equations;
  for (const std::int32_t index : used) {
    const Sight& sight = problem.sights[static_cast<std::size_t>(index)];
    if (!is_in_front(camera_from_world * sight.point_in_world)) continue;
    const WhitenedSight whitened = whiten(problem.rig, camera_from_world, sight);
    const double weight = kernel_weight(RobustKernel::huber, huber, whitened.error.squaredNorm());
    equations.hessian.noalias() += weight * whitened.jacobian.transpose() * whitened.jacobian;
    equations.gradient.noalias() += weight * whitened.jacobian.transpose() * whitened.error;
  }
  return equations;
}

/// False where the sights do not determine the pose.
bool minimise(const Problem& problem, const std::vector<std::int32_t>& used,
              CameraFromWorld& camera_from_world) {
  for (int step = 0; step < kStepsPerRound; ++step) {
    const auto change = build(problem, used, camera_from_world, kHuber).solve();
    if (!change) return false;
    camera_from_world = perturb_left(*change, camera_from_world);
    if (change->norm() < kConvergedStep) break;
  }
  return true;
}

/// Expectation of a chi-square variable that is below its 95 % quantile q: n P(n + 2, q) / 0.95, P being the
/// distribution of the variable with two degrees of freedom more.
double expected_squared_error(const Observation& seen) {
  constexpr double kWithDisparity = 2.459, kWithout = 1.685;
  return seen.has_disparity() ? kWithDisparity : kWithout;
}

void fill_statistics(const Problem& problem, Resection& result) {
  double squared = 0, expected = 0, pixels = 0;
  for (const std::int32_t index : result.inliers) {
    const Sight& sight = problem.sights[static_cast<std::size_t>(index)];
    squared += squared_innovation(problem.rig, result.camera_from_world, sight);
    expected += expected_squared_error(sight.seen);
    const Eigen::Vector3d projected = problem.rig.project(result.camera_from_world * sight.point_in_world);
    pixels += (projected.head<2>() - Eigen::Vector2d(sight.seen.u, sight.seen.v)).squaredNorm();
  }
  constexpr double kParameters = 6;
  result.rms_px = std::sqrt(pixels / static_cast<double>(result.inliers.size()));
  result.variance_factor = expected > kParameters ? squared / (expected - kParameters) : 1.0;
  constexpr double kNoKernel = std::numeric_limits<double>::infinity();
  const Matrix6d information = build(problem, result.inliers, result.camera_from_world, kNoKernel).hessian;
  result.covariance = as_covariance(information.ldlt().solve(Matrix6d::Identity()));
}

}  // namespace

WhitenedSight whiten(const Rig& rig, const CameraFromWorld& camera_from_world, const Sight& sight) {
  const Observation& seen = sight.seen;
  const Eigen::Vector3d point = camera_from_world * sight.point_in_world;
  const Eigen::Vector3d projected = rig.project(point);
  const Eigen::Matrix3d by_world = rig.projection_jacobian(point) * camera_from_world.matrix3();
  WhitenedSight whitened;
  whitened.error = {projected.x() - seen.u, projected.y() - seen.v,
                    seen.has_disparity() ? projected.z() - seen.d : 0.0};
  whitened.jacobian = observation_jacobian(rig, point);
  Eigen::Matrix3d uncertainty = by_world * sight.covariance * by_world.transpose();
  uncertainty.diagonal() += Eigen::Vector3d(seen.sigma_px * seen.sigma_px, seen.sigma_px * seen.sigma_px,
                                            seen.sigma_d_px * seen.sigma_d_px);
  if (!seen.has_disparity()) {  // the third equation is none
    whitened.jacobian.row(2).setZero();
    uncertainty.row(2).setZero();
    uncertainty.col(2).setZero();
    uncertainty(2, 2) = 1;
  }
  const Eigen::LLT<Eigen::Matrix3d> factor(uncertainty);
  factor.matrixL().solveInPlace(whitened.error);
  factor.matrixL().solveInPlace(whitened.jacobian);
  return whitened;
}

double squared_innovation(const Rig& rig, const CameraFromWorld& camera_from_world, const Sight& sight) {
  if (!is_in_front(camera_from_world * sight.point_in_world)) return std::numeric_limits<double>::infinity();
  return whiten(rig, camera_from_world, sight).error.squaredNorm();
}

Resection resect(const Rig& rig, std::span<const Sight> sights,
                 const CameraFromWorld& initial_camera_from_world) {
  const Problem problem{rig, sights};
  Resection result;
  result.camera_from_world = initial_camera_from_world;
  result.inliers = inliers_of(problem, result.camera_from_world);
  for (int round = 0; round < kRounds; ++round) {
    if (result.inliers.size() < kFewest || !minimise(problem, result.inliers, result.camera_from_world))
      return result;
    std::vector<std::int32_t> inliers = inliers_of(problem, result.camera_from_world);
    const bool settled = inliers == result.inliers;
    result.inliers = std::move(inliers);
    if (settled) break;
  }
  if (result.inliers.size() < kFewest ||
      !build(problem, result.inliers, result.camera_from_world, kHuber).solve())
    return result;
  result.solved = true;
  fill_statistics(problem, result);
  return result;
}

}  // namespace cairn
