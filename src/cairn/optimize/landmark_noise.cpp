// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_noise.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cairn/geometry/covariance.h"
#include "cairn/optimize/variance_components.h"

namespace cairn {
namespace {

using Eigen::ArrayXd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::int64_t kFewest = 128, kEvery = 2048;  // landmarks
constexpr std::size_t kMostSamples = 4096;
constexpr double kMostShare = 0.995;      // of disparities: above, parallax says nothing
constexpr double kLeastRedundancy = 0.5;  // less says nothing of the noise
constexpr double kLeastErrors = 1e-4;     // per redundancy: a fit without residuals

/// Adds up what the observations of a point say.
class InformationSum {
 public:
  InformationSum(const Rig& rig, const Vector3d& point_in_world)
      : rig_(rig), point_in_world_(point_in_world) {}

  void add(const CameraFromWorld& camera, const Observation& seen) {
    const Vector3d point = camera * point_in_world_;
    const Matrix3d jacobian = rig_.projection_jacobian(point) * Rigid3(camera).matrix3();
    const Vector3d weights = inverse_variances(seen),
                   error = rig_.project(point) - Vector3d(seen.u, seen.v, seen.d);
    const auto of_pixel = jacobian.topRows<2>();
    sum_.pixels.noalias() += weights[0] * of_pixel.transpose() * of_pixel;
    sum_.errors.pixel_errors += weights[0] * error.head<2>().squaredNorm();
    ++sum_.errors.observations;
    if (!seen.has_disparity()) return;
    ++disparities_;
    sum_.disparities.noalias() += weights[2] * jacobian.row(2).transpose() * jacobian.row(2);
    sum_.errors.disparity_errors += weights[2] * error[2] * error[2];
    mean_gradient_ += weights[2] * jacobian.row(2).transpose();
    weighted_error_ += weights[2] * error[2];
    weight_ += weights[2];
  }

  [[nodiscard]] LandmarkInformation finish() {
    const Matrix3d inverse = (sum_.pixels + sum_.disparities).inverse();
    const double by_disparities = (inverse * sum_.disparities).trace();  // of the three values of the point
    sum_.errors.pixel_redundancy = 2.0 * sum_.errors.observations - (3 - by_disparities);
    sum_.errors.disparity_redundancy = disparities_ - by_disparities;
    if (disparities_ > 0) compare_depths(inverse);
    return sum_;
  }

 private:
  /// Compares what disparities and pixels say of the depth, with the inverse N^-1 of all information: the
  /// mean error m of disparities is e - g^T N^-1 (J_p^T W_p e_p + J_d^T W_d e_d) / W before and after the
  /// fit.
  void compare_depths(const Matrix3d& inverse) {
    const Vector3d gain = inverse * mean_gradient_;
    const double by_disparities = gain.dot(sum_.disparities * gain) / weight_;
    sum_.errors.disparity_share = std::clamp(mean_gradient_.dot(gain) / weight_, 0.0, 1.0);
    if (sum_.errors.disparity_share >= kMostShare) return;
    sum_.errors.disagreement = weighted_error_ * weighted_error_ / weight_;
    sum_.errors.disagreement_by_pixels = gain.dot(sum_.pixels * gain) / weight_;
    sum_.errors.disagreement_by_disparities =
        std::max(0.0, 1 - 2 * sum_.errors.disparity_share + by_disparities);
  }

  const Rig& rig_;
  Vector3d point_in_world_;
  LandmarkInformation sum_;
  int disparities_ = 0;
  Vector3d mean_gradient_ = Vector3d::Zero();
  double weighted_error_ = 0, weight_ = 0;
};

/// Computes the typical ratio of errors and redundancies: the mean of logarithms, which blurred landmarks
/// hardly move. 1 if there are none.
double typical(const std::vector<LandmarkErrors>& samples, double LandmarkErrors::*errors,
               double LandmarkErrors::*redundancy) {
  double sum = 0, count = 0;
  for (const LandmarkErrors& sample : samples) {
    if (!(sample.*redundancy > 1)) continue;
    sum += std::log(std::max(kLeastErrors, sample.*errors / sample.*redundancy));
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : 1;
}

/// Solves for the components, from a start in which all have the same share.
ArrayXd solve(const VarianceComponents& problem) {
  constexpr int kMaxIterations = 200;
  constexpr double kConverged = 1e-4, kTiny = 1e-12;  // relative
  constexpr double kLeast = 1e-9;                     // of the mean square, so that nothing is divided by 0
  const double mean = (problem.weights * problem.squares).sum() / problem.weights.sum();
  const auto count = static_cast<double>(problem.parts.cols());
  ArrayXd components = mean / (count * (problem.parts.colwise().mean().transpose() + kTiny));
  for (int i = 0; i < kMaxIterations; ++i) {
    const ArrayXd next = problem.improved(components, kLeast * mean).max(kTiny * components);
    const double change = (next - components).abs().maxCoeff() / (components.maxCoeff() + kTiny);
    components = next;
    if (change < kConverged) break;
  }
  return components;
}

/// Estimates the noise of the samples.
class NoiseFit {
 public:
  explicit NoiseFit(const std::vector<LandmarkErrors>& samples) : samples_(samples) {
    noise_.pixel_scale = typical(samples, &LandmarkErrors::pixel_errors, &LandmarkErrors::pixel_redundancy);
    noise_.disparity_scale =
        typical(samples, &LandmarkErrors::disparity_errors, &LandmarkErrors::disparity_redundancy);
    fit_own();
    fit_scatter();
    fit_disagreement();
  }

  [[nodiscard]] const LandmarkNoise& noise() const { return noise_; }

 private:
  void fit_own() {
    VarianceModel model;
    for (const LandmarkErrors& sample : samples_)
      if (sample.redundancy() >= 1) model.add(noise_.scaled_errors(sample), sample.redundancy());
    noise_.own = model.prior();
    for (const LandmarkErrors& sample : samples_) factors_.push_back(noise_.factor_of(sample));
  }

  void fit_scatter() {
    const ArrayXd disparities =
        fit_scatter(2, &LandmarkErrors::disparity_errors, &LandmarkErrors::disparity_redundancy);
    if (disparities.size() > 0) noise_.disparities = {disparities[1], disparities[0]};
    const ArrayXd pixels = fit_scatter(1, &LandmarkErrors::pixel_errors, &LandmarkErrors::pixel_redundancy);
    if (pixels.size() > 0) noise_.pixels[0] = pixels[0];
  }
  /// Returns the parts of the variance: in proportion to a landmark's own factor and, if there are two, of
  /// all alike; none if too few landmarks show them.
  [[nodiscard]] ArrayXd fit_scatter(Eigen::Index parts, double LandmarkErrors::*errors,
                                    double LandmarkErrors::*redundancy) const {
    const auto used =
        select([&](const LandmarkErrors& sample) { return sample.*redundancy > kLeastRedundancy; });
    if (static_cast<std::int64_t>(used.size()) < kFewest) return {};
    VarianceComponents problem(static_cast<Eigen::Index>(used.size()), parts);
    problem.cut = 6;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const LandmarkErrors& sample = samples_[used[i]];
      const auto row = static_cast<Eigen::Index>(i);
      problem.parts(row, 0) = factors_[used[i]];
      problem.squares[row] = sample.*errors / (sample.*redundancy);
      problem.weights[row] = sample.*redundancy;
    }
    return solve(problem);
  }

  void fit_disagreement() {
    const auto used = select([](const LandmarkErrors& sample) { return sample.disagreement > 0; });
    if (static_cast<std::int64_t>(used.size()) < kFewest) return;
    VarianceComponents problem(static_cast<Eigen::Index>(used.size()), 2);
    problem.cut = 2.25;     // 1.5 standard deviations
    problem.kept = 0.7785;  // mean of min(x^2, 2.25) of a standard normal x
    for (std::size_t i = 0; i < used.size(); ++i) {
      const LandmarkErrors& sample = samples_[used[i]];
      const auto row = static_cast<Eigen::Index>(i);
      const double factor = factors_[used[i]], unit = 1 / (1 - sample.disparity_share);
      const double by_pixels = unit * factor * sample.disagreement_by_pixels;
      problem.parts.row(row) << by_pixels * sample.observations, by_pixels * (1 - sample.disparity_share);
      problem.known[row] =
          noise_.pixels[0] * by_pixels + (noise_.disparities[0] + noise_.disparities[1] * factor) * unit *
                                             sample.disagreement_by_disparities;
      problem.squares[row] = unit * sample.disagreement;
    }
    const ArrayXd found = solve(problem);
    noise_.pixels[1] = found[0];
    noise_.pixels[2] = found[1];
  }

  template <class Condition>
  [[nodiscard]] std::vector<std::size_t> select(Condition condition) const {
    std::vector<std::size_t> selected;
    for (std::size_t i = 0; i < samples_.size(); ++i)
      if (condition(samples_[i])) selected.push_back(i);
    return selected;
  }

  const std::vector<LandmarkErrors>& samples_;
  LandmarkNoise noise_;
  std::vector<double> factors_;
};

}  // namespace

LandmarkInformation information_of(const Rig& rig, std::span<const CameraFromWorld> cameras,
                                   std::span<const CameraObservation> observations,
                                   const Vector3d& point_in_world) {
  InformationSum sum(rig, point_in_world);
  for (const CameraObservation& observation : observations)
    sum.add(cameras[static_cast<std::size_t>(observation.camera)], observation.seen);
  return sum.finish();
}

Matrix3d LandmarkNoise::covariance_of(const LandmarkInformation& landmark) const {
  const LandmarkErrors& errors = landmark.errors;
  const double factor = factor_of(errors);
  const double of_pixels =
      factor * (pixels[0] + pixels[1] * errors.observations + pixels[2] * (1 - errors.disparity_share));
  const double of_disparities = disparities[0] + disparities[1] * factor;
  const Matrix3d inverse = (landmark.pixels + landmark.disparities).inverse();
  const Matrix3d covariance =
      inverse * (of_pixels * landmark.pixels + of_disparities * landmark.disparities) * inverse;
  if (!covariance.allFinite())
    return Vector3d::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
  return as_covariance(covariance);
}

void LandmarkNoiseModel::add(const LandmarkErrors& landmark) {
  if (!std::isfinite(landmark.pixel_redundancy) || !std::isfinite(landmark.disagreement)) return;
  if (samples_.size() < kMostSamples)
    samples_.push_back(landmark);
  else
    samples_[static_cast<std::size_t>(count_) % kMostSamples] = landmark;
  ++count_;
  const bool is_due =
      count_ % kEvery == 0 || (count_ >= kFewest && std::has_single_bit(static_cast<std::uint64_t>(count_)));
  if (is_due) noise_ = NoiseFit(samples_).noise();
}

}  // namespace cairn
