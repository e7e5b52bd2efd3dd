// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_adjustment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/optimize/bundle_equations.h"
#include "cairn/optimize/bundle_structure.h"

namespace cairn {
namespace {

/// One adjustment under way; without a border no field is estimated.
class Adjustment {
 public:
  Adjustment(const BundleProblem& problem, const BundleStructure& structure, const BundleOptions& options,
             const Executor& executor, FieldBorder* border = nullptr)
      : options_(options),
        equations_(problem.rig, structure, options, executor, border),
        state_(problem, structure),
        moved_(state_) {}

  void start_field_at(const DisparityField& field) { state_.field = field; }

  [[nodiscard]] BundleReport run() {
    equations_.evaluate_costs(state_);
    BundleReport report;
    report.cost_before = state_.cost;
    report.status = BundleStatus::undetermined;
    while (report.status != BundleStatus::ok && report.iterations < options_.max_iterations) {
      ++report.iterations;
      report.status = step(report.status);
    }
    report.cost_after = state_.cost;
    return report;
  }

  [[nodiscard]] const BundleState& state() const { return state_; }
  /// Solves the equations at the result without damping, if there is no gauge in the way. False if there is
  /// no solution.
  [[nodiscard]] bool solve_at_result() {
    for (const double lambda : {0.0, kLeastLambda}) {
      equations_.build(state_, lambda);
      if (equations_.solve()) return true;
    }
    return false;
  }
  [[nodiscard]] std::size_t disparities() const { return equations_.count_disparities(); }

 private:
  /// `status` is undetermined until the equations have had a solution.
  [[nodiscard]] BundleStatus step(BundleStatus status) {
    equations_.build(state_, lambda_);
    if (!equations_.solve()) {
      lambda_ *= kRaise;
      return status;
    }
    equations_.move(state_, moved_);
    const double gain = state_.cost - moved_.cost;
    constexpr double kRounding = 1e-12;  // relative error of the cost
    if (!(gain >= -kRounding * state_.cost)) {
      lambda_ *= kRaise;
      return BundleStatus::not_converged;
    }
    lambda_ = std::max(kLeastLambda, kLower * lambda_);
    const bool converged = gain <= options_.converged_relative_cost * state_.cost;
    std::swap(state_, moved_);
    return converged ? BundleStatus::ok : BundleStatus::not_converged;
  }

  static constexpr double kRaise = 10.0, kLower = 0.1;  // Marquardt 1963
  static constexpr double kLeastLambda = 1e-9;          // keeps a bundle without a fixed camera solvable

  const BundleOptions& options_;
  BundleEquations equations_;
  BundleState state_, moved_;
  double lambda_ = 1e-4;
};

void store(const BundleState& state, const BundleStructure& structure, BundleProblem& problem) {
  problem.camera_from_world = state.camera_from_world;
  for (std::size_t i = 0; i < structure.points.size(); ++i)
    problem.points_in_world[static_cast<std::size_t>(structure.points[i])] = state.points[i];
}

/// Judges the observations with the field taken off their disparities.
std::vector<char> find_inliers(const BundleProblem& problem, const DisparityField& field) {
  const std::vector<MatrixPose> poses = to_matrix_poses(problem.camera_from_world);
  std::vector<char> inlier;
  inlier.reserve(problem.observations.size());
  for (const auto& [camera, point, measured] : problem.observations) {
    const Eigen::Vector3d in_camera =
        poses[static_cast<std::size_t>(camera)] * problem.points_in_world[static_cast<std::size_t>(point)];
    Observation seen = measured;
    seen.d -= disparity_field_basis(problem.rig, seen.u).dot(field);
    inlier.push_back(squared_error(problem.rig, in_camera, seen) < squared_error_limit(seen) ? 1 : 0);
  }
  return inlier;
}

Eigen::Matrix3d covariance_of(const PointSums& sums) {
  if (sums.determine_point()) return as_covariance(sums.information.inverse());
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
}

}  // namespace

void BundleOptions::validate() const {
  require(kernel_scale > 0 && std::isfinite(kernel_scale), "kernel_scale is above 0");
  require(max_iterations >= 1, "max_iterations is at least 1");
  require(converged_relative_cost > 0 && converged_relative_cost < 1,
          "converged_relative_cost is between 0 and 1");
}

void FieldOptions::validate() const {
  require(prior_sigma_px > 0 && std::isfinite(prior_sigma_px), "prior_sigma_px is above 0");
}

std::string_view to_string(BundleStatus status) {
  switch (status) {
    case BundleStatus::not_converged:
      return "not converged";
    case BundleStatus::undetermined:
      return "the observations do not determine the cameras";
    case BundleStatus::nothing_free:
      return "nothing to adjust";
    case BundleStatus::ok:
      break;
  }
  return "ok";
}

BundleReport adjust_bundle(BundleProblem& problem, const BundleOptions& options, const Executor& executor) {
  options.validate();
  require_bundle(problem);
  if (problem.observations.empty()) return {};
  const BundleStructure structure = analyse_bundle(problem);
  Adjustment adjustment(problem, structure, options, executor);
  BundleReport report = adjustment.run();
  store(adjustment.state(), structure, problem);
  report.inlier = find_inliers(problem, DisparityField::Zero());
  return report;
}

FieldReport adjust_bundle_with_field(BundleProblem& problem, DisparityField& field,
                                     const BundleOptions& options, const FieldOptions& field_options,
                                     const Executor& executor) {
  options.validate();
  field_options.validate();
  require_bundle(problem);
  require(field.allFinite(), "the field is finite");
  FieldReport report;
  report.field = field;
  report.covariance =
      field_options.prior_sigma_px * field_options.prior_sigma_px * Eigen::Matrix3d::Identity();
  if (problem.observations.empty()) return report;
  const BundleStructure structure = analyse_bundle(problem);
  FieldBorder border(problem.rig, structure, field_options.prior_sigma_px);
  Adjustment adjustment(problem, structure, options, executor, &border);
  adjustment.start_field_at(field);
  report.bundle = adjustment.run();
  store(adjustment.state(), structure, problem);
  report.field = field = adjustment.state().field;
  report.bundle.inlier = find_inliers(problem, field);
  if (report.bundle.status != BundleStatus::undetermined && adjustment.solve_at_result())
    report.covariance = border.covariance();
  report.disparities = adjustment.disparities();
  return report;
}

std::vector<Eigen::Matrix3d> point_covariances(const BundleProblem& problem,
                                               std::span<const char> use_observation,
                                               const Executor& executor) {
  require_bundle(problem);
  require(use_observation.size() == problem.observations.size(), "use_observation has one for each");
  const std::vector<MatrixPose> poses = to_matrix_poses(problem.camera_from_world);
  std::vector<std::int32_t> point_of;
  for (const auto& observation : problem.observations) point_of.push_back(observation.point);
  const Groups by_point = group_items(point_of, problem.points_in_world.size());
  return executor.map<Eigen::Matrix3d>(problem.points_in_world.size(), [&](std::size_t point) {
    PointSums sums;
    for (const std::size_t i : by_point.of(point)) {
      const BundleObservation& observation = problem.observations[i];
      const MatrixPose& pose = poses[static_cast<std::size_t>(observation.camera)];
      const Eigen::Vector3d in_camera = pose * problem.points_in_world[point];
      if (use_observation[i] == 0 || !is_in_front(in_camera)) continue;
      sums.add({problem.rig, in_camera, make_term(observation), RobustKernel::none, 1.0}, pose.rotation);
    }
    return covariance_of(sums);
  });
}

}  // namespace cairn
