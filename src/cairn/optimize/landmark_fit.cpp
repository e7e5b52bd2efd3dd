// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/optimize/bundle_term.h"
#include "cairn/optimize/landmark_start.h"

namespace cairn {
namespace {

/// A point and what the sightings say of it.
struct LandmarkState {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  LandmarkSums sums{};
};

PointSums equations_of(const LandmarkSums& sums) {
  const double* h = sums.hessian;
  PointSums equations;
  equations.information << h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5];
  equations.gradient = Eigen::Vector3d(sums.gradient[0], sums.gradient[1], sums.gradient[2]);
  return equations;
}

/// Nothing where the sums do not determine the point.
std::optional<Eigen::Vector3d> step_from(const LandmarkSums& sums, double lambda) {
  PointSums equations = equations_of(sums);
  if (!equations.determine_point()) return std::nullopt;
  equations.information.diagonal() *= 1.0 + lambda;
  return Eigen::Vector3d(-equations.information.inverse() * equations.gradient);
}

/// One minimisation over the sightings that are packed.
class Descent {
 public:
  Descent(const LandmarkKernels& kernels, const LandmarkFitOptions& options, const PackedSightings& packed,
          SightingErrors& errors)
      : kernels_(kernels), options_(options), packed_(packed), errors_(errors) {}

  LandmarkFitStatus run(const Eigen::Vector3d& start) {
    state_ = evaluate(kernels_.linearise, start);
    if (!std::isfinite(state_.sums.squared_error)) return LandmarkFitStatus::not_converged;
    begin();
    LandmarkFitStatus status = LandmarkFitStatus::not_converged;
    while (status == LandmarkFitStatus::not_converged && iterations_ < options_.max_iterations)
      status = step();
    if (!errors_are_of_state_) state_ = evaluate(kernels_.expand, state_.point);
    return status;
  }

  /// The squared errors are those of this state.
  [[nodiscard]] const LandmarkState& state() const { return state_; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  [[nodiscard]] LandmarkState evaluate(LandmarkExpansion* expansion, const Eigen::Vector3d& point) {
    LandmarkState at{.point = point};
    expansion(packed_.blocks(), packed_.block_count(), at.point.data(), &at.sums, errors_.of_pixels.data(),
              errors_.of_all.data());
    errors_are_of_state_ = true;
    return at;
  }

  /// To the solution of the linear equations, where it is better than the start.
  void begin() {
    if (const auto linear_step = step_from(state_.sums, 0); linear_step && try_step(*linear_step)) return;
    state_ = evaluate(kernels_.expand, state_.point);
  }

  /// Whether it did not raise the cost.
  [[nodiscard]] bool try_step(const Eigen::Vector3d& step) {
    constexpr double kRounding = 1e-12;  // relative error of the cost
    const LandmarkState moved = evaluate(kernels_.expand, state_.point + step);
    errors_are_of_state_ = moved.sums.squared_error <= state_.sums.squared_error * (1 + kRounding);
    if (errors_are_of_state_) state_ = moved;
    return errors_are_of_state_;
  }

  [[nodiscard]] LandmarkFitStatus step() {
    const auto step = step_from(state_.sums, lambda_);
    if (!step) return LandmarkFitStatus::undetermined;
    ++iterations_;
    const bool damped = lambda_ > 0.0, negligible = !damped && is_negligible(*step);
    const bool last = negligible || (!damped && distance_after(step->norm()) < options_.converged_step);
    const bool accepted = try_step(*step);
    if (negligible || (last && accepted)) return LandmarkFitStatus::ok;
    last_length_ = accepted && !damped ? step->norm() : 0.0;
    constexpr double kFirstLambda = 1e-3, kLeastLambda = 1e-6, kRaise = 10, kLower = 0.1;
    lambda_ = accepted ? kLower * lambda_ : std::max(kFirstLambda, kRaise * lambda_);
    if (lambda_ < kLeastLambda) lambda_ = 0.0;
    return LandmarkFitStatus::not_converged;
  }

  /// Shorter than converged_step or, where the point is so badly determined that rounding moves it further, a
  /// hundred millionth of its standard deviation.
  [[nodiscard]] bool is_negligible(const Eigen::Vector3d& step) const {
    constexpr double kDeviations = 1e-8;
    const double* gradient = state_.sums.gradient;
    const double squared_deviations =
        -(step[0] * gradient[0] + step[1] * gradient[1] + step[2] * gradient[2]);
    return step.norm() < options_.converged_step || squared_deviations < kDeviations * kDeviations;
  }

  /// How far the minimum still is after an undamped step of this length: steps get shorter by a factor that
  /// changes little.
  [[nodiscard]] double distance_after(double length) const {
    const double factor = length / last_length_;
    return factor < 0.5 ? length * factor / (1 - factor) : length;
  }

  const LandmarkKernels& kernels_;
  const LandmarkFitOptions& options_;
  const PackedSightings& packed_;
  SightingErrors& errors_;
  LandmarkState state_;
  bool errors_are_of_state_ = false;
  int iterations_ = 0;
  double lambda_ = 0;
  double last_length_ = 0;  // of the step before where it was undamped and accepted
};

}  // namespace

void LandmarkFitOptions::validate() const {
  require(min_observations >= 1, "min_observations is at least 1");
  require(max_error > 0, "max_error is above 0");
  require(max_iterations >= 1, "max_iterations is at least 1");
  require(converged_step > 0, "converged_step is above 0");
}

std::string_view to_string(LandmarkFitStatus status) {
  constexpr std::array<std::string_view, 4> kNames{"ok", "too few", "undetermined", "not converged"};
  return kNames[static_cast<std::size_t>(status)];
}

class LandmarkSolver::Work {
 public:
  Work(const Rig& rig, std::span<const CameraFromWorld> cameras, const LandmarkFitOptions& options,
       InstructionSet set)
      : rig_(rig), options_(options), kernels_(landmark_kernels(set)) {
    options.validate();
    require(rig.fx > 0 && rig.fy > 0 && rig.baseline > 0, "focal lengths and baseline are above 0");
    for (const CameraFromWorld& camera : cameras) {
      require(camera.rotation.coeffs().allFinite() && camera.translation.allFinite(), "poses are finite");
      cameras_.emplace_back(camera);
    }
  }

  void fit(std::span<const LandmarkSighting> sightings, LandmarkFit& fit) {
    packed_.pack(rig_, cameras_, sightings);
    errors_.make_room(packed_.block_count());
    fit.status = LandmarkFitStatus::too_few;
    fit.point_in_world.setZero();
    fit.covariance.setZero();
    fit.squared_error_sum = fit.rms_px = 0;
    fit.redundancy = -3;
    fit.iterations = 0;
    fit.kept.assign(sightings.size(), 0);
    if (packed_.count() >= options_.min_observations) solve(sightings, fit);
    count_kept(sightings, fit);
  }

 private:
  void solve(std::span<const LandmarkSighting> sightings, LandmarkFit& fit) {
    const LandmarkStart start(rig_, cameras_, sightings, packed_);
    if (minimise(start.quick(), fit) && fit.status == LandmarkFitStatus::ok) return;
    const Eigen::Vector3d initial = start.robust(kernels_, errors_);
    while (!minimise(initial, fit)) {
      drop_worst();
      if (packed_.count() >= options_.min_observations) continue;
      fit.status = LandmarkFitStatus::too_few;
      fit.covariance.setZero();
      return;
    }
  }

  /// Whether all sightings' errors at the result are below max_error.
  [[nodiscard]] bool minimise(const Eigen::Vector3d& initial, LandmarkFit& fit) {
    Descent descent(kernels_, options_, packed_, errors_);
    fit.status = descent.run(initial);
    const auto& [point, sums] = descent.state();
    fit.point_in_world = packed_.origin_in_world() + point;
    fit.squared_error_sum = sums.squared_error;
    fit.iterations = descent.iterations();
    if (fit.status == LandmarkFitStatus::ok) fit.covariance = equations_of(sums).information.inverse();
    return sums.worst <= options_.max_error * options_.max_error;
  }

  void drop_worst() {
    const auto begin = errors_.of_all.begin();
    packed_.drop(static_cast<int>(std::max_element(begin, begin + packed_.count()) - begin));
  }

  void count_kept(std::span<const LandmarkSighting> sightings, LandmarkFit& fit) const {
    double squared_px = 0;
    for (int slot = 0; slot < packed_.count(); ++slot) {
      const auto index = static_cast<std::size_t>(packed_.sighting(slot));
      const Observation& seen = sightings[index].seen;
      fit.kept[index] = 1;
      fit.redundancy += seen.has_disparity() ? 3 : 2;
      squared_px += errors_.of_pixels[static_cast<std::size_t>(slot)] * seen.sigma_px * seen.sigma_px;
    }
    if (packed_.count() > 0) fit.rms_px = std::sqrt(squared_px / packed_.count());
  }

  Rig rig_;
  LandmarkFitOptions options_;
  const LandmarkKernels& kernels_;
  std::vector<PlacedCamera> cameras_;
  PackedSightings packed_;
  SightingErrors errors_;
};

LandmarkSolver::LandmarkSolver(const Rig& rig, std::span<const CameraFromWorld> cameras,
                               const LandmarkFitOptions& options, InstructionSet set)
    : work_(std::make_unique<Work>(rig, cameras, options, set)) {}
LandmarkSolver::~LandmarkSolver() = default;
LandmarkSolver::LandmarkSolver(LandmarkSolver&&) noexcept = default;
LandmarkSolver& LandmarkSolver::operator=(LandmarkSolver&&) noexcept = default;

void LandmarkSolver::fit(std::span<const LandmarkSighting> sightings, LandmarkFit& fit) {
  work_->fit(sightings, fit);
}

LandmarkFit fit_landmark(const Rig& rig, std::span<const CameraFromWorld> cameras,
                         std::span<const LandmarkSighting> sightings, const LandmarkFitOptions& options) {
  LandmarkSolver solver(rig, cameras, options);
  LandmarkFit result;
  solver.fit(sightings, result);
  return result;
}

}  // namespace cairn
