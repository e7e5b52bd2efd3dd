// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/executor.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {

/// Says how many times too small the formal standard deviations of a field are: fields of both halves of six
/// recordings differed by 2 to 11 of them.
constexpr double kFieldSigmaInflation = 10;

/// Holds what a bundle says of the field of a stereo pair's disparities, and what was done about it.
struct DisparityCalibration {
  DisparityField field = DisparityField::Zero();  ///< pixels
  /// Standard deviations of its terms, pixels: ten times the formal ones, as parts of a recording differ.
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  double rms_px = 0;     ///< of the field over the disparities
  double cost_fall = 0;  ///< share of the adjustment's cost that the field explains
  /// Root mean square over the disparities of the difference between the fields of the first and the second
  /// half of the cameras; 0 where the rest spoke against the field already.
  double halves_differ_px = 0;
  std::int64_t disparities = 0;  ///< disparities that it was estimated from; 0: it was not
  int estimates = 0;             ///< how often it was estimated
  bool applied = false;          ///< whether it was taken off all disparities

  /// Returns whether the bundle determines the field: enough disparities, and c0 to 0.3 px.
  [[nodiscard]] bool is_determined() const;
  /// Returns whether the field is determined, explains what does not fit, is large enough to matter, and is
  /// larger than what the fields of both halves of the cameras differ by.
  [[nodiscard]] bool should_be_applied() const;
};

/// Adjusts a problem without a field until it converges, and returns its cost, which judge_field compares.
[[nodiscard]] double adjusted_cost(BundleProblem& problem, const Executor& executor);

/// Estimates the field of disparities that the field `from` was taken off already, in all: cameras, points
/// and field together, with a prior of 1 px on each term, in formal standard deviations times ten. Moves the
/// cameras that are not fixed and the points of the problem to where they are with the field. `calibration`
/// takes field, sigma, rms and counts.
[[nodiscard]] FieldReport estimate_field(BundleProblem& problem, const DisparityField& from,
                                         const Executor& executor, DisparityCalibration& calibration);

/// Computes the root mean square over the disparities of the difference between the fields of the first and
/// the second half of the cameras.
[[nodiscard]] double halves_difference_px(const BundleProblem& problem, const Executor& executor);

/// Judges a field that was estimated for a problem: sets what it explains of the cost, and, where that speaks
/// for it, how far both halves of the cameras agree.
void judge_field(const BundleProblem& problem, double cost_without, double cost_with,
                 const Executor& executor, DisparityCalibration& calibration);

}  // namespace cairn
