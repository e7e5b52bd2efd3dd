// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_only.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

struct Problem {
  const Rig& rig;
  std::span<const Eigen::Vector3d> points;
  std::span<const Observation> seen;
};

struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};

double huber_weight(double squared_error, double width) {
  const double error = std::sqrt(squared_error);
  return error <= width ? 1.0 : width / error;
}

void add_observation(const Problem& problem, std::size_t i, const Rigid3& camera_from_world, double huber,
                     NormalEquations& equations) {
  const Observation& seen = problem.seen[i];
  const Eigen::Vector3d point = camera_from_world * problem.points[i];
  const double squared = squared_error(problem.rig, point, seen);
  if (!std::isfinite(squared)) return;
  const double weight = huber_weight(squared, huber);
  const Eigen::Vector3d projected = problem.rig.project(point);
  const Eigen::Vector3d error(projected.x() - seen.u, projected.y() - seen.v,
                              seen.has_disparity() ? projected.z() - seen.d : 0.0);
  const double pixel_weight = weight / (seen.sigma_px * seen.sigma_px);
  const double disparity_weight = seen.has_disparity() ? weight / (seen.sigma_d_px * seen.sigma_d_px) : 0.0;
  const Eigen::Vector3d weights(pixel_weight, pixel_weight, disparity_weight);
  const Eigen::Matrix<double, 3, 6> jacobian = observation_jacobian(problem.rig, point);
  equations.hessian.noalias() += jacobian.transpose() * weights.asDiagonal() * jacobian;
  equations.gradient.noalias() += jacobian.transpose() * weights.cwiseProduct(error);
}

NormalEquations build(const Problem& problem, const std::vector<std::int32_t>& used,
                      const Rigid3& camera_from_world, double huber) {
  NormalEquations equations;
  for (const std::int32_t i : used)
    add_observation(problem, static_cast<std::size_t>(i), camera_from_world, huber, equations);
  return equations;
}

/// False where the observations do not determine the pose.
bool minimise(const Problem& problem, const std::vector<std::int32_t>& used, const PoseOnlyOptions& options,
              Rigid3& camera_from_world) {
  for (int iteration = 0; iteration < options.iterations_per_round; ++iteration) {
    const NormalEquations equations = build(problem, used, camera_from_world, options.huber_px);
    const Eigen::LDLT<Matrix6d> factor(equations.hessian);
    constexpr double kSmallestPivot = 1e-9;
    const auto pivots = factor.vectorD();
    if (factor.info() != Eigen::Success || pivots.minCoeff() <= kSmallestPivot * pivots.maxCoeff())
      return false;
    const Vector6d step = -factor.solve(equations.gradient);
    if (!step.allFinite()) return false;
    camera_from_world = perturb_left(step, camera_from_world);
    if (step.norm() < options.converged_step) break;
  }
  return true;
}

std::vector<std::int32_t> inliers_of(const Problem& problem, const Rigid3& camera_from_world) {
  std::vector<std::int32_t> inliers;
  for (std::size_t i = 0; i < problem.seen.size(); ++i) {
    const double error = squared_error(problem.rig, camera_from_world * problem.points[i], problem.seen[i]);
    if (error < squared_error_limit(problem.seen[i])) inliers.push_back(static_cast<std::int32_t>(i));
  }
  return inliers;
}

void fill_statistics(const Problem& problem, PoseOnlyResult& result) {
  double weighted = 0, pixels = 0;
  std::size_t equations = 0;
  for (const std::int32_t index : result.inliers) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Vector3d point = result.camera_from_world * problem.points[i];
    weighted += squared_error(problem.rig, point, problem.seen[i]);
    const Eigen::Vector3d projected = problem.rig.project(point);
    pixels += (projected.head<2>() - Eigen::Vector2d(problem.seen[i].u, problem.seen[i].v)).squaredNorm();
    equations += problem.seen[i].has_disparity() ? 3 : 2;
  }
  result.rms_px = std::sqrt(pixels / static_cast<double>(result.inliers.size()));
  result.variance_factor = equations > 6 ? weighted / static_cast<double>(equations - 6) : 1.0;
  constexpr double kNoKernel = std::numeric_limits<double>::infinity();
  result.information = build(problem, result.inliers, result.camera_from_world, kNoKernel).hessian;
}

}  // namespace

Eigen::Matrix<double, 3, 6> observation_jacobian(const Rig& rig, const Eigen::Vector3d& point_in_camera) {
  const double inverse_depth = 1.0 / point_in_camera.z();
  const double x = point_in_camera.x() * inverse_depth, y = point_in_camera.y() * inverse_depth;
  Eigen::Matrix3d by_point;  // d(u, v, d) / d(x, y, z)
  by_point << rig.fx, 0, -rig.fx * x, 0, rig.fy, -rig.fy * y, 0, 0, -rig.fx * rig.baseline * inverse_depth;
  by_point *= inverse_depth;
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << -by_point * skew(point_in_camera), by_point;  // exp(w) p + v = p - [p]x w + v
  return jacobian;
}

PoseOnlyResult refine_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                           std::span<const Observation> seen, const Rigid3& initial_camera_from_world,
                           const PoseOnlyOptions& options) {
  require(points_in_world.size() == seen.size(), "each point has one observation");
  const Problem problem{rig, points_in_world, seen};
  constexpr std::size_t kFewest = 4;
  PoseOnlyResult result;
  result.camera_from_world = initial_camera_from_world;
  result.inliers = inliers_of(problem, result.camera_from_world);
  for (int round = 0; round < options.rounds; ++round) {
    if (result.inliers.size() < kFewest ||
        !minimise(problem, result.inliers, options, result.camera_from_world))
      return result;
    std::vector<std::int32_t> inliers = inliers_of(problem, result.camera_from_world);
    const bool settled = inliers == result.inliers;
    result.inliers = std::move(inliers);
    if (settled) break;
  }
  if (result.inliers.size() < kFewest) return result;
  result.solved = true;
  fill_statistics(problem, result);
  return result;
}

}  // namespace cairn
