// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_only.h"

#include <cmath>
#include <numeric>

#include "cairn/core/error.h"
#include "cairn/geometry/pose_equations.h"
#include "cairn/optimize/robust_kernel.h"

namespace cairn {
namespace {

struct Problem {
  const Rig& rig;
  std::span<const Eigen::Vector3d> points;
  std::span<const Observation> seen;
};

PoseEquations build(const Problem& problem, const std::vector<std::int32_t>& used,
                    const Rigid3& camera_from_world, double huber) {
  PoseEquations equations;
  for (const std::int32_t index : used) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Vector3d point = camera_from_world * problem.points[i];
    const double squared = squared_error(problem.rig, point, problem.seen[i]);
    if (std::isfinite(squared))
      equations.add(problem.rig, point, problem.seen[i], kernel_weight(RobustKernel::huber, huber, squared));
  }
  return equations;
}

/// False where the observations do not determine the pose.
bool minimise(const Problem& problem, const std::vector<std::int32_t>& used, const PoseOnlyOptions& options,
              CameraFromWorld& camera_from_world) {
  for (int iteration = 0; iteration < options.iterations_per_round; ++iteration) {
    const auto step = build(problem, used, camera_from_world, options.huber_px).solve();
    if (!step) return false;
    camera_from_world = perturb_left(*step, camera_from_world);
    if (step->norm() < options.converged_step) break;
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

std::vector<std::int32_t> all_of(const Problem& problem) {
  std::vector<std::int32_t> all(problem.seen.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
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

PoseOnlyResult refine_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                           std::span<const Observation> seen,
                           const CameraFromWorld& initial_camera_from_world, const PoseOnlyOptions& options) {
  require(points_in_world.size() == seen.size(), "each point has one observation");
  const Problem problem{rig, points_in_world, seen};
  constexpr std::size_t kFewest = 4;
  PoseOnlyResult result;
  result.camera_from_world = initial_camera_from_world;
  result.inliers = options.begin_with_all ? all_of(problem) : inliers_of(problem, result.camera_from_world);
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
