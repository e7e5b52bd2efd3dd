// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/optimize/bundle_term.h"
#include "cairn/optimize/landmark_start.h"

namespace cairn {
namespace {

/// A point and what the observations say of it.
struct LandmarkState {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  LandmarkSums sums{};
};

/// A symmetric matrix xx, xy, xz, yy, yz, zz by its cofactors, which are the inverse times the determinant.
class Symmetric {
 public:
  explicit Symmetric(const double* a)
      : first_(a[0]),
        trace_(a[0] + a[3] + a[5]),
        cofactors_{a[3] * a[5] - a[4] * a[4], a[2] * a[4] - a[1] * a[5], a[1] * a[4] - a[2] * a[3],
                   a[0] * a[5] - a[2] * a[2], a[1] * a[2] - a[0] * a[4], a[0] * a[3] - a[1] * a[1]},
        determinant_(a[0] * cofactors_[0] + a[1] * cofactors_[1] + a[2] * cofactors_[2]) {}

  /// Positive definite by its leading minors, and not nearly singular.
  [[nodiscard]] bool determines_point() const {
    return first_ > 0 && cofactors_[5] > 0 && cairn::determines_point(trace_, determinant_);
  }
  [[nodiscard]] Eigen::Vector3d solve(const double* right) const {
    const double* c = cofactors_;
    const double share = 1.0 / determinant_, x = share * right[0], y = share * right[1], z = share * right[2];
    return {c[0] * x + c[1] * y + c[2] * z, c[1] * x + c[3] * y + c[4] * z, c[2] * x + c[4] * y + c[5] * z};
  }
  [[nodiscard]] Eigen::Matrix3d inverse() const {
    const double* c = cofactors_;
    return Eigen::Matrix3d{{c[0], c[1], c[2]}, {c[1], c[3], c[4]}, {c[2], c[4], c[5]}} / determinant_;
  }

 private:
  double first_, trace_, cofactors_[6], determinant_;
};

/// One minimisation over the observations that are packed.
class Descent {
 public:
  Descent(const LandmarkKernels& kernels, const LandmarkFitOptions& options, const PackedObservations& packed,
          ObservationErrors& errors)
      : kernels_(kernels), options_(options), packed_(packed), errors_(errors) {}

  LandmarkFitStatus run(const Eigen::Vector3d& start) {
    evaluate(kernels_.linearise, start);
    accept();
    if (!std::isfinite(state().sums.squared_error)) return LandmarkFitStatus::not_converged;
    begin();
    LandmarkFitStatus status = LandmarkFitStatus::not_converged;
    while (status == LandmarkFitStatus::not_converged && iterations_ < options_.max_iterations)
      status = step();
    if (!errors_are_of_state_) {
      evaluate(kernels_.expand, state().point);
      accept();
    }
    return status;
  }

  /// The squared errors are those of this state.
  [[nodiscard]] const LandmarkState& state() const { return states_[current_]; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  [[nodiscard]] LandmarkState& other() { return states_[1 - current_]; }

  void evaluate(LandmarkExpansion* expansion, const Eigen::Vector3d& point) {
    other().point = point;
    expansion(packed_.blocks(), packed_.block_count(), point.data(), &other().sums, errors_.of_pixels.data(),
              errors_.of_all.data());
    errors_are_of_state_ = false;
  }

  void accept() {
    current_ = 1 - current_;
    errors_are_of_state_ = true;
  }

  /// To the solution of the linear equations, where it is better than the start.
  void begin() {
    const Symmetric information(state().sums.information);
    if (information.determines_point() && try_step(-information.solve(state().sums.gradient))) return;
    evaluate(kernels_.expand, state().point);
    accept();
  }

  /// Tries a step; accepts it and returns true if it does not raise the cost.
  bool try_step(const Eigen::Vector3d& step) {
    constexpr double kRounding = 1e-12;  // relative error of the cost
    evaluate(kernels_.expand, state().point + step);
    if (!(other().sums.squared_error <= state().sums.squared_error * (1 + kRounding))) return false;
    accept();
    return true;
  }

  [[nodiscard]] LandmarkFitStatus step() {
    const auto step = lambda_ == 0.0 ? newton_step() : damped_step();
    if (!step) return LandmarkFitStatus::undetermined;
    ++iterations_;
    if (lambda_ == 0.0 && is_last(*step)) return LandmarkFitStatus::ok;
    const bool accepted = try_step(*step);
    last_length_ = accepted && lambda_ == 0.0 ? step->norm() : 0.0;
    constexpr double kFirstLambda = 1e-3, kLeastLambda = 1e-6, kRaise = 10, kLower = 0.1;
    lambda_ = accepted ? kLower * lambda_ : std::max(kFirstLambda, kRaise * lambda_);
    if (lambda_ < kLeastLambda) lambda_ = 0.0;
    return LandmarkFitStatus::not_converged;
  }

  /// With the second derivatives of the errors, unless the cost is not convex.
  [[nodiscard]] std::optional<Eigen::Vector3d> newton_step() const {
    const LandmarkSums& sums = state().sums;
    double hessian[6];
    for (int i = 0; i < 6; ++i) hessian[i] = sums.information[i] + sums.curvature[i];
    const Symmetric newton(hessian);
    if (newton.determines_point()) return -newton.solve(sums.gradient);
    const Symmetric gauss_newton(sums.information);
    if (gauss_newton.determines_point()) return -gauss_newton.solve(sums.gradient);
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> damped_step() const {
    if (!Symmetric(state().sums.information).determines_point()) return std::nullopt;
    double hessian[6];
    std::copy_n(state().sums.information, 6, hessian);
    for (const int diagonal : {0, 3, 5}) hessian[diagonal] *= 1 + lambda_;
    return -Symmetric(hessian).solve(state().sums.gradient);
  }

  /// Takes the last step without looking back: it is shorter than a thousandth of a standard deviation, and
  /// Newton's next step would be shorter than converged_step. Or where the point is so badly determined that
  /// rounding moves it further than that, shorter than a hundred millionth of its standard deviation.
  [[nodiscard]] bool is_last(const Eigen::Vector3d& step) {
    constexpr double kShort = 1e-3, kRounding = 1e-8;  // standard deviations
    const double* gradient = state().sums.gradient;
    const double squared_deviations =
        -(step[0] * gradient[0] + step[1] * gradient[1] + step[2] * gradient[2]);
    const bool last =
        squared_deviations < kRounding * kRounding ||
        (squared_deviations < kShort * kShort && next_length(step.norm()) < options_.converged_step);
    if (!last) return false;
    states_[current_].point += step;
    double& squared_error = states_[current_].sums.squared_error;
    squared_error = std::max(0.0, squared_error - squared_deviations);
    return true;
  }

  /// Of the step after one of this length, as long as they grow with the square of the one before.
  [[nodiscard]] double next_length(double length) const {
    const double share = length / last_length_;
    return share < 0.5 ? length * share * share : length;
  }

  const LandmarkKernels& kernels_;
  const LandmarkFitOptions& options_;
  const PackedObservations& packed_;
  ObservationErrors& errors_;
  std::array<LandmarkState, 2> states_;
  std::size_t current_ = 0;  // the other one is tried
  bool errors_are_of_state_ = false;
  int iterations_ = 0;
  double lambda_ = 0;
  double last_length_ = 0;  // of the step before, where that was undamped and lowered the cost
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

  void fit(std::span<const CameraObservation> observations, LandmarkFit& fit) {
    packed_.pack(rig_, cameras_, observations);
    errors_.make_room(packed_.block_count());
    fit.status = LandmarkFitStatus::too_few;
    fit.point_in_world.setZero();
    fit.covariance.setZero();
    fit.squared_error_sum = fit.rms_px = 0;
    fit.redundancy = -3;
    fit.iterations = 0;
    fit.kept.assign(observations.size(), 0);
    if (packed_.count() >= options_.min_observations) solve(observations, fit);
    count_kept(observations, fit);
  }

 private:
  void solve(std::span<const CameraObservation> observations, LandmarkFit& fit) {
    const LandmarkStart start(rig_, cameras_, observations, packed_);
    if (minimise(start.quick(), fit) && fit.status == LandmarkFitStatus::ok) return;
    const Eigen::Vector3d initial = start.robust(kernels_, errors_);
    while (!minimise(initial, fit)) {
      packed_.drop(static_cast<int>(worst_slot()));
      if (packed_.count() >= options_.min_observations) continue;
      fit.status = LandmarkFitStatus::too_few;
      fit.covariance.setZero();
      fit.squared_error_sum = 0;
      return;
    }
  }

  /// Fits from `initial`. Returns whether the errors of all observations at the result are at most max_error.
  [[nodiscard]] bool minimise(const Eigen::Vector3d& initial, LandmarkFit& fit) {
    Descent descent(kernels_, options_, packed_, errors_);
    fit.status = descent.run(initial);
    const auto& [point, sums] = descent.state();
    fit.point_in_world = packed_.origin_in_world() + point;
    fit.squared_error_sum = sums.squared_error;
    fit.iterations = descent.iterations();
    if (fit.status == LandmarkFitStatus::ok) {
      const Symmetric information(sums.information);
      if (information.determines_point())
        fit.covariance = information.inverse();
      else
        fit.status = LandmarkFitStatus::undetermined;
    }
    return errors_.of_all[worst_slot()] <= options_.max_error * options_.max_error;
  }

  [[nodiscard]] std::size_t worst_slot() const {
    const auto begin = errors_.of_all.begin();
    return static_cast<std::size_t>(std::max_element(begin, begin + packed_.count()) - begin);
  }

  void count_kept(std::span<const CameraObservation> observations, LandmarkFit& fit) const {
    double squared_px = 0;
    for (int slot = 0; slot < packed_.count(); ++slot) {
      const auto index = static_cast<std::size_t>(packed_.observation(slot));
      const Observation& seen = observations[index].seen;
      fit.kept[index] = 1;
      fit.redundancy += seen.has_disparity() ? 3 : 2;
      squared_px += errors_.of_pixels[static_cast<std::size_t>(slot)] * seen.sigma_px * seen.sigma_px;
    }
    if (fit.status != LandmarkFitStatus::too_few) fit.rms_px = std::sqrt(squared_px / packed_.count());
  }

  Rig rig_;
  LandmarkFitOptions options_;
  const LandmarkKernels& kernels_;
  std::vector<PlacedCamera> cameras_;
  PackedObservations packed_;
  ObservationErrors errors_;
};

LandmarkSolver::LandmarkSolver(const Rig& rig, std::span<const CameraFromWorld> cameras,
                               const LandmarkFitOptions& options, InstructionSet set)
    : work_(std::make_unique<Work>(rig, cameras, options, set)) {}
LandmarkSolver::~LandmarkSolver() = default;
LandmarkSolver::LandmarkSolver(LandmarkSolver&&) noexcept = default;
LandmarkSolver& LandmarkSolver::operator=(LandmarkSolver&&) noexcept = default;

void LandmarkSolver::fit(std::span<const CameraObservation> observations, LandmarkFit& fit) {
  work_->fit(observations, fit);
}

LandmarkFit fit_landmark(const Rig& rig, std::span<const CameraFromWorld> cameras,
                         std::span<const CameraObservation> observations, const LandmarkFitOptions& options) {
  LandmarkSolver solver(rig, cameras, options);
  LandmarkFit result;
  solver.fit(observations, result);
  return result;
}

}  // namespace cairn
