// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/optimize/packed_observations.h"
#include "cairn/optimize/variance_model.h"

namespace cairn {

/// Holds by how much the observations of a landmark miss its adjusted point. Pixels (u, v) and disparities
/// are kept apart, because their noise is. All is by the standard deviations that the observations state,
/// cameras taken as exact.
struct LandmarkErrors {
  /// Sums of squared errors, in variances, and their redundancies: values that were measured, less those that
  /// the point took. That of the disparities is 0 if there are none.
  double pixel_errors = 0, disparity_errors = 0, pixel_redundancy = 0, disparity_redundancy = 0;
  /// Share l of the mean disparity's information that is in the point: 1 if nothing else says how far it is,
  /// 0 if the parallax of its pixels says all.
  double disparity_share = 0;
  /// By how much disparities and parallax disagree on the depth: the square of the weighted mean of the
  /// errors of disparities, in variances of such a mean of independent errors before the fit. Its expectation
  /// is `disagreement_by_pixels` times the pixels' variance plus `disagreement_by_disparities` times theirs.
  /// All are 0 unless both say something of the depth (l < 0.995).
  double disagreement = 0, disagreement_by_pixels = 0, disagreement_by_disparities = 0;
  double observations = 0;  ///< their number

  [[nodiscard]] double redundancy() const { return pixel_redundancy + disparity_redundancy; }
};

/// Holds what the observations of a landmark say of its point, at the adjusted point.
struct LandmarkInformation {
  Eigen::Matrix3d pixels = Eigen::Matrix3d::Zero();  ///< inverse covariance by u and v, 1 / m^2
  Eigen::Matrix3d disparities =
      Eigen::Matrix3d::Zero();  ///< the same by the disparities; zero: there are none
  LandmarkErrors errors;
};

/// Computes what observations say of a point. `cameras` are what their numbers count.
[[nodiscard]] LandmarkInformation information_of(const Rig& rig, std::span<const CameraFromWorld> cameras,
                                                 std::span<const CameraObservation> observations,
                                                 const Eigen::Vector3d& point_in_world);

/// Holds what the landmarks of a recording show of the noise of their observations. A landmark has a factor f
/// of its own, drawn towards that of all (VariancePrior): some are blurred. Beside it, a disparity has the
/// variance b0 + b1 f, a pixel f (a0 + a1 n + a2 (1 - l)), each times what it states, with the number n of
/// observations and LandmarkInformation::disparity_share l. The part with n is what the pixels of a landmark
/// have in common, as the centre of a feature wanders with the view and neighbouring poses err alike; it
/// wanders more if the view changes more, and then parallax says more of the depth than disparities do.
struct LandmarkNoise {
  double pixel_scale = 1, disparity_scale = 1;  ///< typical squared errors per redundancy
  VariancePrior own;                            ///< of f, by errors in units of these scales
  std::array<double, 2> disparities{0, 1};      ///< b0, b1
  std::array<double, 3> pixels{1, 0, 0};        ///< a0, a1, a2

  /// Computes the squared errors of a landmark in units of the scales.
  [[nodiscard]] double scaled_errors(const LandmarkErrors& errors) const {
    return errors.pixel_errors / pixel_scale + errors.disparity_errors / disparity_scale;
  }
  /// Computes f of a landmark.
  [[nodiscard]] double factor_of(const LandmarkErrors& errors) const {
    return own.factor(scaled_errors(errors), errors.redundancy());
  }
  /// Computes the covariance of a landmark's point, square metres. If the information does not determine the
  /// point, it has infinity on the diagonal and zeros elsewhere.
  [[nodiscard]] Eigen::Matrix3d covariance_of(const LandmarkInformation& landmark) const;
};

/// Estimates the noise from landmarks alone, without truth: b0, b1 and a0 from how disparities and pixels of
/// a landmark scatter, a1 and a2 from how far disparities and parallax disagree, both as variance components
/// that stay positive (Zhou, Hu, Zhou, Lange 2019), with errors cut off. Knows the last 4096 landmarks. Gives
/// the same bits whenever it is asked.
class LandmarkNoiseModel {
 public:
  /// Adds a landmark; ignores one whose observations do not determine its point.
  void add(const LandmarkErrors& landmark);
  /// Returns the noise, as estimated when a power of two times 128 landmarks were added, or the last multiple
  /// of 2048; the default of LandmarkNoise until there are 128.
  [[nodiscard]] const LandmarkNoise& noise() const { return noise_; }
  [[nodiscard]] std::int64_t count() const { return count_; }

  LandmarkNoiseModel() = default;
  /// Restores a model of which `samples`, `count` and `noise` were stored.
  LandmarkNoiseModel(std::vector<LandmarkErrors>&& samples, std::int64_t count, const LandmarkNoise& noise)
      : samples_(std::move(samples)), count_(count), noise_(noise) {}
  [[nodiscard]] const std::vector<LandmarkErrors>& samples() const { return samples_; }

 private:
  std::vector<LandmarkErrors> samples_;  // a ring
  std::int64_t count_ = 0;
  LandmarkNoise noise_;
};

}  // namespace cairn
