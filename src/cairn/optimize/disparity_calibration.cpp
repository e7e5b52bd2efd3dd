// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/disparity_calibration.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

/// Standard deviation of each term before anything is seen, pixels: with 700 px of focal length that of a
/// camera turned by a twelfth of a degree.
constexpr double kPriorPx = 1;

double rms_of(const DisparityField& field, const BundleProblem& problem) {
  double squares = 0, count = 0;
  for (const BundleObservation& observation : problem.observations) {
    if (!observation.seen.has_disparity()) continue;
    squares += std::pow(field.dot(disparity_field_basis(problem.rig, observation.seen.u)), 2);
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Gives the disparities back what was taken off them.
void add_field(const DisparityField& field, BundleProblem& problem) {
  for (BundleObservation& observation : problem.observations)
    if (observation.seen.has_disparity())
      observation.seen.d += field.dot(disparity_field_basis(problem.rig, observation.seen.u));
}

/// Keeps the observations of the cameras with positions in [begin, end), and fixes the first of these.
BundleProblem part_of(BundleProblem problem, std::size_t begin, std::size_t end) {
  const auto is_outside = [&](std::size_t camera) { return camera < begin || camera >= end; };
  std::erase_if(problem.observations, [&](const BundleObservation& seen) {
    return is_outside(static_cast<std::size_t>(seen.camera));
  });
  for (std::size_t camera = 0; camera < problem.camera_fixed.size(); ++camera)
    if (is_outside(camera) || camera == begin) problem.camera_fixed[camera] = 1;
  return problem;
}

/// Returns options with which an adjustment does not end before it has converged.
BundleOptions until_converged() {
  BundleOptions options;
  options.max_iterations = 50;
  return options;
}

FieldReport adjust_with_field(BundleProblem& problem, DisparityField field, const Executor& executor) {
  return adjust_bundle_with_field(problem, field, until_converged(), {kPriorPx / kFieldSigmaInflation},
                                  executor);
}

}  // namespace

bool DisparityCalibration::is_determined() const {
  constexpr std::int64_t kMinDisparities = 300;
  constexpr double kMaxSigma = 0.3;  // pixels, of c0
  return disparities >= kMinDisparities && sigma[0] < kMaxSigma;
}

bool DisparityCalibration::should_be_applied() const {
  constexpr double kMinRmsPx = 0.15;     // what the terms were seen to change from part to part
  constexpr double kMinCostFall = 0.01;  // less was seen only where nothing was wrong
  return is_determined() && rms_px > kMinRmsPx && cost_fall > kMinCostFall && halves_differ_px < rms_px;
}

double adjusted_cost(BundleProblem& problem, const Executor& executor) {
  return adjust_bundle(problem, until_converged(), executor).cost_after;
}

FieldReport estimate_field(BundleProblem& problem, const DisparityField& from, const Executor& executor,
                           DisparityCalibration& calibration) {
  add_field(from, problem);
  FieldReport report = adjust_with_field(problem, from, executor);
  ++calibration.estimates;
  calibration.field = report.field;
  calibration.sigma = kFieldSigmaInflation * report.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  calibration.rms_px = rms_of(report.field, problem);
  calibration.disparities = static_cast<std::int64_t>(report.disparities);
  return report;
}

void judge_field(const BundleProblem& problem, double cost_without, double cost_with,
                 const Executor& executor, DisparityCalibration& calibration) {
  calibration.cost_fall = cost_without > 0 ? std::max(0.0, 1 - cost_with / cost_without) : 0;
  calibration.halves_differ_px = 0;
  if (!calibration.should_be_applied()) return;  // both halves take as long as the whole
  calibration.halves_differ_px = halves_difference_px(problem, executor);
}

double halves_difference_px(const BundleProblem& problem, const Executor& executor) {
  const std::size_t count = problem.camera_fixed.size();
  BundleProblem first = part_of(problem, 0, count / 2), second = part_of(problem, count / 2, count);
  const DisparityField none = DisparityField::Zero();
  const DisparityField difference =
      adjust_with_field(first, none, executor).field - adjust_with_field(second, none, executor).field;
  return rms_of(difference, problem);
}

}  // namespace cairn
