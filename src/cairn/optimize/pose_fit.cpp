// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

/// One fit under way.
class Fit {
 public:
  Fit(const Rig& rig, std::span<const Eigen::Vector3d> points, std::span<const Observation> seen,
      const PoseFitOptions& options)
      : rig_(rig), points_(points), seen_(seen), options_(options) {}

  [[nodiscard]] PoseFit run(const CameraFromWorld& start) {
    result_.camera_from_world = start;
    result_.cost = cost(start);
    result_.trace.push_back({result_.cost, 0, 0, true});
    result_.status = PoseFitStatus::not_converged;
    if (!std::isfinite(result_.cost)) result_.status = PoseFitStatus::behind_camera;
    while (result_.status == PoseFitStatus::not_converged && result_.iterations() < options_.max_iterations)
      result_.status = step();
    if (result_.status == PoseFitStatus::ok) result_.status = finish();
    return std::move(result_);
  }

 private:
  /// Infinite where a point lies behind the camera.
  [[nodiscard]] double cost(const Rigid3& camera_from_world) const {
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double squared = squared_error(rig_, camera_from_world * points_[i], seen_[i]);
      if (!std::isfinite(squared)) return squared;
      sum += kernel_cost(options_.kernel, options_.kernel_scale, squared);
    }
    return 0.5 * sum;
  }

  [[nodiscard]] PoseEquations equations() const {
    PoseEquations equations;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d point = result_.camera_from_world * points_[i];
      const double squared = squared_error(rig_, point, seen_[i]);
      equations.add(rig_, point, seen_[i], kernel_weight(options_.kernel, options_.kernel_scale, squared));
    }
    return equations;
  }

  [[nodiscard]] PoseFitStatus step() {
    PoseEquations normal = equations();
    const bool damped = options_.method == PoseFitMethod::levenberg_marquardt;
    if (damped) normal.hessian.diagonal() *= 1.0 + lambda_;
    const auto xi = normal.solve();
    if (!xi) return PoseFitStatus::undetermined;
    const CameraFromWorld moved = perturb_left(*xi, result_.camera_from_world);
    const double moved_cost = cost(moved);
    constexpr double kRounding = 1e-12;  // relative error of the cost
    const bool accepted = moved_cost <= result_.cost * (1 + kRounding);
    result_.trace.push_back({moved_cost, xi->norm(), damped ? lambda_ : 0.0, accepted});
    if (accepted) {
      result_.camera_from_world = moved;
      result_.cost = moved_cost;
    } else if (!damped) {
      return std::isfinite(moved_cost) ? PoseFitStatus::rising_cost : PoseFitStatus::behind_camera;
    }
    lambda_ = accepted ? std::max(1e-12, 0.1 * lambda_) : 10.0 * lambda_;
    // a rejected step that is this short leaves nothing to gain, either
    return xi->norm() < options_.converged_step ? PoseFitStatus::ok : PoseFitStatus::not_converged;
  }

  [[nodiscard]] PoseFitStatus finish() {
    const PoseEquations normal = equations();
    if (!normal.solve()) return PoseFitStatus::undetermined;
    std::size_t measured = 0;
    for (const Observation& observation : seen_) measured += observation.has_disparity() ? 3 : 2;
    result_.covariance = as_covariance(normal.hessian.inverse());
    result_.variance_factor = 2.0 * result_.cost / static_cast<double>(measured - 6);
    return PoseFitStatus::ok;
  }

  const Rig& rig_;
  std::span<const Eigen::Vector3d> points_;
  std::span<const Observation> seen_;
  const PoseFitOptions& options_;
  PoseFit result_;
  double lambda_ = 1e-4;
};

}  // namespace

void PoseFitOptions::validate() const {
  require(kernel_scale > 0, "kernel_scale is above 0");
  require(max_iterations >= 1, "max_iterations is at least 1");
  require(converged_step > 0, "converged_step is above 0");
}

std::string_view to_string(PoseFitStatus status) {
  switch (status) {
    case PoseFitStatus::too_few_points:
      return "fewer than four points";
    case PoseFitStatus::undetermined:
      return "the points do not determine the pose";
    case PoseFitStatus::behind_camera:
      return "points lie behind the camera";
    case PoseFitStatus::rising_cost:
      return "a Gauss-Newton step raised the cost";
    case PoseFitStatus::not_converged:
      return "not converged";
    case PoseFitStatus::ok:
      break;
  }
  return "ok";
}

PoseFit fit_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                 std::span<const Observation> seen, const CameraFromWorld& initial_camera_from_world,
                 const PoseFitOptions& options) {
  options.validate();
  require(points_in_world.size() == seen.size(), "each point has one observation");
  require_observations(points_in_world, seen);
  constexpr std::size_t kFewest = 4;
  if (seen.size() < kFewest) return {};
  return Fit(rig, points_in_world, seen, options).run(initial_camera_from_world);
}

}  // namespace cairn
