// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/disparity_noise_estimate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/median.h"
#include "cairn/optimize/variance_components.h"

namespace cairn {
namespace {

constexpr std::size_t kFewest = 200;      // disparities
constexpr double kLeastRedundancy = 0.1;  // less says more of the other observations than of the disparity
constexpr double kCut = 1.5;              // standard deviations at which a residual is cut off
/// Mean of min(x^2, kCut^2) of a standard normal x.
constexpr double kCutSquares = 0.7785;
constexpr double kLeastSigmaPx = 0.01, kLeastSigmaM = 1e-5;

/// Holds the residual of a disparity as the variance components need it.
struct Residual {
  double square = 0;    // over its redundancy, pixels^2
  double by_depth = 0;  // (d^2 / (fx b))^2: the disparity's variance for a depth's variance of 1 m^2
};

/// Holds what the observations of one point say of it.
struct PointInformation {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  int disparities = 0;
};

/// Collects the residuals of a problem.
class ResidualCollector {
 public:
  explicit ResidualCollector(const BundleProblem& problem)
      : problem_(problem), points_(problem.points_in_world.size()) {
    for (const Rigid3& pose : problem.camera_from_world) rotations_.push_back(pose.matrix3());
    for (const BundleObservation& seen : problem.observations) add(seen);
    invert();
  }

  [[nodiscard]] std::vector<Residual> collect() const {
    std::vector<Residual> residuals;
    for (const BundleObservation& seen : problem_.observations)
      if (const auto residual = residual_of(seen)) residuals.push_back(*residual);
    return residuals;
  }

 private:
  [[nodiscard]] Eigen::Vector3d in_camera(const BundleObservation& seen) const {
    return problem_.camera_from_world[static_cast<std::size_t>(seen.camera)] *
           problem_.points_in_world[static_cast<std::size_t>(seen.point)];
  }
  /// Returns whether the pixel fits.
  [[nodiscard]] bool fits(const BundleObservation& observation) const {
    const Observation pixel = without_disparity(observation.seen);
    return squared_error(problem_.rig, in_camera(observation), pixel) < squared_error_limit(pixel);
  }
  [[nodiscard]] Eigen::Matrix3d jacobian(const BundleObservation& seen) const {
    return problem_.rig.projection_jacobian(in_camera(seen)) *
           rotations_[static_cast<std::size_t>(seen.camera)];
  }

  void add(const BundleObservation& observation) {
    if (!fits(observation)) return;
    PointInformation& point = points_[static_cast<std::size_t>(observation.point)];
    const Eigen::Matrix3d derivative = jacobian(observation);
    point.information +=
        derivative.transpose() * inverse_variances(observation.seen).asDiagonal() * derivative;
    point.disparities += observation.seen.has_disparity() ? 1 : 0;
  }

  void invert() {
    for (const PointInformation& point : points_) {
      const bool is_known = point.disparities > 0 && point.information.determinant() > 0;
      covariances_.push_back(is_known ? Eigen::Matrix3d(point.information.inverse())
                                      : Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
    }
  }

  [[nodiscard]] std::optional<Residual> residual_of(const BundleObservation& observation) const {
    const Observation& seen = observation.seen;
    const Eigen::Matrix3d& covariance = covariances_[static_cast<std::size_t>(observation.point)];
    if (!seen.has_disparity() || covariance.isZero(0) || !fits(observation)) return std::nullopt;
    const Eigen::RowVector3d row = jacobian(observation).row(2);
    const double variance = seen.sigma_d_px * seen.sigma_d_px;
    const double redundancy = 1 - (row * covariance).dot(row) / variance;
    if (!(redundancy > kLeastRedundancy)) return std::nullopt;
    const double error = problem_.rig.project(in_camera(observation)).z() - seen.d;
    const double per_m = problem_.rig.disparity_per_metre(seen.d);
    return Residual{error * error / redundancy, per_m * per_m};
  }

  const BundleProblem& problem_;
  std::vector<PointInformation> points_;
  std::vector<Eigen::Matrix3d> covariances_;
  std::vector<Eigen::Matrix3d> rotations_;
};

/// Returns a start that is right if the noise is all in disparity.
double first_sigma(const std::vector<Residual>& residuals) {
  std::vector<double> squares;
  for (const Residual& residual : residuals) squares.push_back(residual.square);
  return std::max(kLeastSigmaPx, kSigmaPerMedian * std::sqrt(median(std::move(squares))));
}

/// Returns the components of the residuals' variance: in disparity, and in depth.
VarianceComponents components_of(const std::vector<Residual>& residuals) {
  VarianceComponents components(static_cast<Eigen::Index>(residuals.size()), 2);
  components.cut = kCut * kCut;
  components.kept = kCutSquares;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    components.parts(row, 1) = residuals[i].by_depth;
    components.squares[row] = residuals[i].square;
  }
  return components;
}

DisparityNoise fit(const std::vector<Residual>& residuals) {
  const double first = first_sigma(residuals);
  double mean_by_depth = 0;
  for (const Residual& residual : residuals) mean_by_depth += residual.by_depth;
  mean_by_depth /= static_cast<double>(residuals.size());
  Eigen::Array2d variances(0.5 * first * first, 0.5 * first * first / mean_by_depth);
  const Eigen::Array2d least(kLeastSigmaPx * kLeastSigmaPx, kLeastSigmaM * kLeastSigmaM);
  constexpr int kMaxIterations = 100;
  constexpr double kConverged = 1e-3;                                    // relative
  constexpr double kLeastVariance = std::numeric_limits<double>::min();  // none is as small
  const VarianceComponents components = components_of(residuals);
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Array2d next = components.improved(variances, kLeastVariance).max(least);
    const double change = ((next - variances).abs() / variances).maxCoeff();
    variances = next;
    if (change < kConverged) break;
  }
  return {std::sqrt(variances[0]), std::sqrt(variances[1])};
}

}  // namespace

std::optional<DisparityNoiseEstimate> estimate_disparity_noise(const BundleProblem& problem) {
  const std::vector<Residual> residuals = ResidualCollector(problem).collect();
  if (residuals.size() < kFewest) return std::nullopt;
  return DisparityNoiseEstimate{fit(residuals), problem.rig, static_cast<std::int64_t>(residuals.size())};
}

void weigh_disparities(const DisparityNoise& noise, BundleProblem& problem) {
  for (auto& [camera, point, seen] : problem.observations)
    if (seen.has_disparity()) seen.sigma_d_px = noise.at(problem.rig, seen.d);
}

}  // namespace cairn
