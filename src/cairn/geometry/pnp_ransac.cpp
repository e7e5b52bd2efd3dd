// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pnp_ransac.h"

#include <algorithm>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/camera_pose.h"
#include "cairn/geometry/p3p.h"
#include "cairn/geometry/point_pairs.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

/// camera_from_world as a matrix, which maps points faster than a quaternion.
struct CameraPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

CameraPose pose_of(const Rigid3& camera_from_world) {
  return {camera_from_world.matrix3(), camera_from_world.translation};
}

/// Bounds what a disparity adds to the squared error: however wrong it is, the pixel may be right.
constexpr double kDisparityBound = kInlierLimit3 - kInlierLimit2;

struct PnpProblem {
  using Model = CameraPose;
  static constexpr std::size_t kSampleSize = 3, kMaxModels = 4;

  const Rig& rig;
  std::span<const Eigen::Vector3d> points;
  std::span<const Observation> seen;
  bool keep_pixels = true;

  [[nodiscard]] std::size_t size() const { return points.size(); }

  std::size_t solve(const std::array<std::uint32_t, kSampleSize>& sample,
                    std::array<Model, kMaxModels>& models) const {
    std::array<Eigen::Vector3d, kSampleSize> in_world, rays;
    for (std::size_t i = 0; i < kSampleSize; ++i) {
      const Observation& observation = seen[sample[i]];
      in_world[i] = points[sample[i]];
      rays[i] = rig.point_at(observation.u, observation.v, 1.0).normalized();
    }
    const P3pSolutions solutions = solve_p3p(in_world, rays);
    for (std::size_t i = 0; i < solutions.count; ++i) models[i] = pose_of(solutions.camera_from_world[i]);
    return solutions.count;
  }

  [[nodiscard]] double squared_error(const Model& pose, std::size_t i) const {
    const Eigen::Vector3d point = pose.rotation * points[i] + pose.translation;
    const double all = cairn::squared_error(rig, point, seen[i]);
    if (!keep_pixels || !seen[i].has_disparity() || all <= kDisparityBound) return all;
    const double pixel = cairn::squared_error(rig, point, without_disparity(seen[i]));
    return std::min(all, pixel + kDisparityBound);
  }
  [[nodiscard]] double limit(std::size_t i) const { return squared_error_limit(seen[i]); }

  bool refine(std::span<const std::int32_t> inliers, Model& pose) const {
    std::vector<Eigen::Vector3d> inlier_points;
    std::vector<Observation> inlier_observations;
    for (const std::int32_t index : inliers) {
      const auto i = static_cast<std::size_t>(index);
      inlier_points.push_back(points[i]);
      const Eigen::Vector3d point = pose.rotation * points[i] + pose.translation;
      const Observation pixel = without_disparity(seen[i]);
      const double added =
          cairn::squared_error(rig, point, seen[i]) - cairn::squared_error(rig, point, pixel);
      inlier_observations.push_back(keep_pixels && added > kGrossLimit1 ? pixel : seen[i]);
    }
    const CameraFromWorld start({Eigen::Quaterniond(pose.rotation), pose.translation});
    constexpr int kIterations = 3;  // RANSAC asks again with the inliers of the result
    const PoseEstimate found = estimate_pose(rig, {inlier_points, inlier_observations}, start,
                                             {.selection = PoseSelection::all,
                                              .method = PoseMethod::gauss_newton,
                                              .kernel = RobustKernel::none,
                                              .max_iterations = kIterations});
    const bool improved = found.status == PoseStatus::ok || found.status == PoseStatus::not_converged ||
                          found.status == PoseStatus::rising_cost;
    if (improved) pose = pose_of(found.camera_from_world);
    return improved;
  }

  /// A wrong pixel lies in the disc around the place where the pose has it.
  [[nodiscard]] double chance() const {
    std::vector<Eigen::Vector2d> pixels;
    double area = 0;
    for (const Observation& observation : seen) {
      pixels.emplace_back(observation.u, observation.v);
      area +=
          std::numbers::pi * squared_error_limit(observation) * observation.sigma_px * observation.sigma_px;
    }
    return area / static_cast<double>(seen.size()) / extent_of(pixels).area;
  }
};

PnpProblem problem_of(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                      std::span<const Observation> seen) {
  require(points_in_world.size() == seen.size(), "each point has one observation");
  require_observations(points_in_world, seen);
  return {rig, points_in_world, seen};
}

}  // namespace

PnpResult solve_pnp_ransac(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                           std::span<const Observation> seen, const RansacOptions& options,
                           bool keep_pixels) {
  PnpProblem problem = problem_of(rig, points_in_world, seen);
  problem.keep_pixels = keep_pixels;
  const RansacResult<CameraPose> found = Ransac(problem, options).run();
  return {found, CameraFromWorld({Eigen::Quaterniond(found.model.rotation), found.model.translation})};
}

RansacReport judge_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                        std::span<const Observation> seen, const CameraFromWorld& camera_from_world) {
  const PnpProblem problem = problem_of(rig, points_in_world, seen);
  RansacReport report;
  if (seen.size() < PnpProblem::kSampleSize) return report;
  const CameraPose pose = pose_of(camera_from_world);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double error = problem.squared_error(pose, i), limit = problem.limit(i);
    if (error < limit) report.inliers.push_back(static_cast<std::int32_t>(i));
    report.cost += std::min(error, limit);
  }
  report.log10_false_alarms = log10_false_alarms(report.inliers.size(), seen.size(), PnpProblem::kSampleSize,
                                                 PnpProblem::kMaxModels, problem.chance());
  report.status = report.verdict();
  return report;
}

}  // namespace cairn
