// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/geometry/kernel_moments.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

constexpr std::size_t kFewest = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One estimate under way.
class PoseSolver {
 public:
  PoseSolver(const Rig& rig, const Correspondences& given, const PoseOptions& options)
      : rig_(rig),
        given_(given),
        seen_(given.observations.begin(), given.observations.end()),
        options_(options),
        exact_(given.covariances.empty()) {}

  [[nodiscard]] PoseEstimate run(const CameraFromWorld& start) {
    result_.camera_from_world = start;
    select_first();
    for (int round = 0; round < options_.rounds; ++round) {
      result_.status = used_.size() < kFewest ? PoseStatus::too_few_points : minimise();
      if (result_.status != PoseStatus::ok && result_.status != PoseStatus::not_converged) {
        if (round == 0) forget_inliers();  // they are those of the start
        return std::move(result_);
      }
      const std::vector<std::int32_t> left_out = result_.wrong_disparities;
      find_inliers();
      if (options_.selection == PoseSelection::all) break;
      truncated_ = true;
      if (used_ == result_.inliers && left_out == result_.wrong_disparities) break;
      use_inliers();
    }
    result_.rms_px = used_.empty() ? 0 : rms_px();
    if (result_.status == PoseStatus::ok)  // of the last round: one before may end early
      result_.status = used_.size() < kFewest ? PoseStatus::too_few_points : assess();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Eigen::Vector3d in_camera(const CameraFromWorld& pose, std::int32_t i) const {
    return pose * given_.points_in_world[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const Observation& seen(std::int32_t i) const { return seen_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] WhitenedError whitened(std::int32_t i) const {
    const CameraFromWorld& pose = result_.camera_from_world;
    const auto at = static_cast<std::size_t>(i);
    return exact_ ? whiten(rig_, in_camera(pose, i), seen(i))
                  : whiten(rig_, pose, given_.points_in_world[at], seen(i), given_.covariances[at]);
  }

  /// Infinite for a point behind the camera.
  [[nodiscard]] double squared(const CameraFromWorld& pose, std::int32_t i) const {
    const Eigen::Vector3d point = in_camera(pose, i);
    if (exact_ || !is_in_front(point)) return squared_error(rig_, point, seen(i));
    return whitened(i).error.squaredNorm();
  }

  /// As `squared` at another pose, with the uncertainty that the point has at the current one: a step must
  /// not look better because it makes the point less certain.
  [[nodiscard]] double squared_after_step(const CameraFromWorld& moved, std::int32_t i) const {
    const Eigen::Vector3d point = in_camera(moved, i);
    if (exact_ || !is_in_front(point)) return squared_error(rig_, point, seen(i));
    const Eigen::Matrix3d covariance = innovation_covariance(rig_, result_.camera_from_world.matrix3(),
                                                             in_camera(result_.camera_from_world, i), seen(i),
                                                             given_.covariances[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d projected = rig_.project(point);
    const Eigen::Vector3d error(projected.x() - seen(i).u, projected.y() - seen(i).v,
                                seen(i).has_disparity() ? projected.z() - seen(i).d : 0.0);
    return error.dot(covariance.llt().solve(error));
  }

  [[nodiscard]] double weight(double squared_error) const {
    return kernel_weight(options_.kernel, options_.kernel_scale, squared_error);
  }

  /// Judges the observations as they were given.
  [[nodiscard]] Agreement judge(std::int32_t i) {
    Observation& seen = seen_[static_cast<std::size_t>(i)];
    seen = given_.observations[static_cast<std::size_t>(i)];
    const double all = squared(result_.camera_from_world, i);
    if (!seen.has_disparity() || all < squared_error_limit(seen)) return agreement_by(all, all, seen);
    const Observation given = std::exchange(seen, without_disparity(seen));
    const double pixel = squared(result_.camera_from_world, i);
    seen = given;
    return agreement_by(all, pixel, seen);
  }

  void forget_inliers() {
    result_.inliers.clear();
    result_.wrong_disparities.clear();
  }

  void find_inliers() {
    const std::vector<Observation> used = seen_;
    forget_inliers();
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(given_.size()); ++i) {
      Agreement agreement = judge(i);
      if (agreement == Agreement::pixel && !options_.keep_pixels) agreement = Agreement::none;
      if (agreement != Agreement::none) result_.inliers.push_back(i);
      if (agreement == Agreement::pixel) result_.wrong_disparities.push_back(i);
    }
    seen_ = used;
  }

  void use_inliers() {
    used_ = result_.inliers;
    seen_.assign(given_.observations.begin(), given_.observations.end());
    for (const std::int32_t i : result_.wrong_disparities)
      seen_[static_cast<std::size_t>(i)] = without_disparity(seen(i));
  }

  void select_first() {
    if (options_.selection == PoseSelection::inliers) {
      find_inliers();
      use_inliers();
      return;
    }
    used_.resize(given_.size());
    std::iota(used_.begin(), used_.end(), 0);
    if (options_.selection == PoseSelection::inliers_from_all)  // a rough start may have points behind it
      std::erase_if(used_,
                    [&](std::int32_t i) { return !is_in_front(in_camera(result_.camera_from_world, i)); });
  }

  template <class Squared>
  [[nodiscard]] double cost(const Squared& squared_of) const {
    double sum = 0;
    for (const std::int32_t i : used_) {
      const double error = squared_of(i);
      if (!std::isfinite(error)) return kInfinity;
      sum += kernel_cost(options_.kernel, options_.kernel_scale, error);
    }
    return 0.5 * sum;
  }
  [[nodiscard]] double current_cost() const {
    return cost([&](std::int32_t i) { return squared(result_.camera_from_world, i); });
  }

  [[nodiscard]] PoseEquations equations() const {
    PoseEquations sum;
    for (const std::int32_t i : used_) {
      const WhitenedError one = whitened(i);
      sum.add(one, weight(one.error.squaredNorm()));
    }
    return sum;
  }

  /// One round.
  [[nodiscard]] PoseStatus minimise() {
    result_.cost = current_cost();
    result_.trace.push_back({result_.cost, 0, 0, true});
    if (!std::isfinite(result_.cost)) return PoseStatus::behind_camera;
    constexpr double kFirstLambda = 1e-4;
    lambda_ = kFirstLambda;
    PoseEquations normal = equations();
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      const PoseStatus status = step(normal);
      if (status != PoseStatus::not_converged) return status;
      if (result_.trace.back().accepted) normal = equations();
    }
    return PoseStatus::not_converged;
  }

  [[nodiscard]] PoseStatus step(PoseEquations normal) {
    const bool damped = options_.method == PoseMethod::levenberg_marquardt;
    if (damped) normal.hessian.diagonal() *= 1.0 + lambda_;
    const auto xi = normal.solve();
    if (!xi) return PoseStatus::undetermined;
    const CameraFromWorld moved = perturb_left(*xi, result_.camera_from_world);
    const double moved_cost = cost([&](std::int32_t i) { return squared_after_step(moved, i); });
    constexpr double kRounding = 1e-12;  // relative error of the cost
    const bool accepted = moved_cost <= result_.cost * (1 + kRounding);
    result_.trace.push_back({moved_cost, xi->norm(), damped ? lambda_ : 0.0, accepted});
    if (accepted) {
      result_.camera_from_world = moved;
      result_.cost = exact_ ? moved_cost : current_cost();
    } else if (!damped) {
      return std::isfinite(moved_cost) ? PoseStatus::rising_cost : PoseStatus::behind_camera;
    }
    lambda_ = accepted ? std::max(1e-12, 0.1 * lambda_) : 10.0 * lambda_;
    // a rejected step that is this short leaves nothing to gain, either
    return xi->norm() < options_.converged_step ? PoseStatus::ok : PoseStatus::not_converged;
  }

  [[nodiscard]] double rms_px() const {
    double squares = 0;
    for (const std::int32_t i : used_) {
      const Eigen::Vector3d projected = rig_.project(in_camera(result_.camera_from_world, i));
      squares += (projected.head<2>() - Eigen::Vector2d(seen(i).u, seen(i).v)).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(used_.size()));
  }

  /// The observations of one kind, with or without a disparity, at the solution.
  struct Kind {
    int dimension = 2;
    KernelMoments moments;
    double count = 0;
    Matrix6d plain = Matrix6d::Zero(), weighted = Matrix6d::Zero();  // sums of J^T J
  };
  [[nodiscard]] Kind kind_of(bool stereo) const {
    Observation example;
    if (stereo) example.d = 0;
    const int dimension = stereo ? 3 : 2;
    const double limit = truncated_ ? squared_error_limit(example) : kInfinity;
    return {dimension, kernel_moments(options_.kernel, options_.kernel_scale, dimension, limit)};
  }

  /// Covariance and variance factor at the solution.
  [[nodiscard]] PoseStatus assess() {
    std::array<Kind, 2> kinds{kind_of(false), kind_of(true)};
    double squares = 0;
    for (const std::int32_t i : used_) {
      const WhitenedError one = whitened(i);
      const double error = one.error.squaredNorm();
      const Matrix6d information = one.jacobian.transpose() * one.jacobian;
      Kind& kind = kinds[seen(i).has_disparity()];
      kind.count += 1;
      kind.plain += information;
      kind.weighted += weight(error) * information;
      squares += weight(error) * error;
    }
    PoseEquations sensitivity;
    Matrix6d force = Matrix6d::Zero();
    for (const Kind& kind : kinds) {
      sensitivity.hessian += kind.moments.sensitivity / kind.moments.weight * kind.weighted;
      force += kind.moments.force / kind.moments.weight * kind.weighted;
    }
    if (!sensitivity.solve()) return PoseStatus::undetermined;
    const Matrix6d inverse = sensitivity.hessian.inverse();
    result_.covariance = as_covariance(inverse * force * inverse);
    result_.cost = current_cost();
    const double expected = expected_squares(kinds, inverse);
    result_.variance_factor = expected > 0 ? squares / expected : 1.0;
    return PoseStatus::ok;
  }

  /// What the weighted squared errors sum up to if the standard deviations are right. Residuals are smaller
  /// than errors: the pose follows its observations. With psi = w e, an error e moves the pose by A^-1 J^T
  /// psi, so that the variance of the residual e - J xi is 1 - 2 E[psi e] J A^-1 J^T + J C J^T; without
  /// kernel and limit 1 - J C J^T. The sum over a kind of tr(J M J^T) is that of M times the sum of J^T J.
  [[nodiscard]] double expected_squares(const std::array<Kind, 2>& kinds, const Matrix6d& inverse) const {
    double sum = 0;
    for (const Kind& kind : kinds) {
      if (kind.count == 0) continue;
      const double coordinates = kind.count * kind.dimension,
                   follows = inverse.cwiseProduct(kind.plain).sum() / coordinates,
                   spread = result_.covariance.cwiseProduct(kind.plain).sum() / coordinates;
      const double variance = 1 - 2 * kind.moments.share * kind.moments.sensitivity * follows + spread;
      sum += kind.count * kind.moments.expected_squares(variance);
    }
    return sum;
  }

  const Rig& rig_;
  const Correspondences& given_;
  std::vector<Observation> seen_;  // as given, without the disparities that are left out
  const PoseOptions& options_;
  const bool exact_;
  std::vector<std::int32_t> used_;  // positions of the correspondences that count
  bool truncated_ = false;          // those are the ones within the limit
  PoseEstimate result_;
  double lambda_ = 0;
};

}  // namespace

void PoseOptions::validate() const {
  require(kernel_scale > 0, "kernel_scale is above 0");
  require(rounds >= 1, "rounds is at least 1");
  require(max_iterations >= 1, "max_iterations is at least 1");
  require(converged_step > 0, "converged_step is above 0");
}

std::string_view to_string(PoseStatus status) {
  switch (status) {
    case PoseStatus::too_few_points:
      return "fewer than four points";
    case PoseStatus::undetermined:
      return "the points do not determine the pose";
    case PoseStatus::behind_camera:
      return "points lie behind the camera";
    case PoseStatus::rising_cost:
      return "a Gauss-Newton step raised the cost";
    case PoseStatus::not_converged:
      return "not converged";
    case PoseStatus::ok:
      break;
  }
  return "ok";
}

int PoseEstimate::iterations() const {
  return static_cast<int>(
      std::count_if(trace.begin(), trace.end(), [](const PoseIteration& row) { return row.step > 0; }));
}

PoseEstimate estimate_pose(const Rig& rig, const Correspondences& correspondences,
                           const CameraFromWorld& initial_camera_from_world, const PoseOptions& options) {
  options.validate();
  require(correspondences.points_in_world.size() == correspondences.size(), "each point has one observation");
  require(correspondences.covariances.empty() || correspondences.covariances.size() == correspondences.size(),
          "each point has one covariance, or none has");
  require_observations(correspondences.points_in_world, correspondences.observations);
  return PoseSolver(rig, correspondences, options).run(initial_camera_from_world);
}

}  // namespace cairn
