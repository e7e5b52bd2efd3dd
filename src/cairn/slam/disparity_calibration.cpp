// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/disparity_calibration.h"

#include <algorithm>
#include <cmath>

#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {
namespace {

/// Says how many times too small the formal standard deviations of a field are: fields of both halves of six
/// recordings differed by 2 to 11 of them.
constexpr double kTooSure = 10;
/// Standard deviation of each term before anything is seen, pixels: that of a camera turned by a twentieth of
/// a degree.
constexpr double kPriorPx = 1;
constexpr double kMaxSigma0 = 0.3;  // pixels: of c0, where the recording determines it

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

/// Keeps the observations of the cameras with positions in [begin, end).
BundleProblem part_of(BundleProblem problem, std::int32_t begin, std::int32_t end) {
  std::erase_if(problem.observations,
                [&](const BundleObservation& seen) { return seen.camera < begin || seen.camera >= end; });
  for (std::size_t c = 0; c < problem.camera_fixed.size(); ++c)
    if (static_cast<std::int32_t>(c) < begin || static_cast<std::int32_t>(c) >= end)
      problem.camera_fixed[c] = 1;
  problem.camera_fixed[static_cast<std::size_t>(begin)] = 1;
  return problem;
}

/// Estimates the field of disparities that `from` was taken off already; moves what the problem holds.
FieldReport estimate_field(BundleProblem& problem, const DisparityField& from, const Executor& executor) {
  add_field(from, problem);
  DisparityField field = from;
  return adjust_bundle_with_field(problem, field, {}, {kPriorPx / kTooSure}, executor);
}

}  // namespace

bool DisparityCalibration::determined() const {
  constexpr std::int64_t kMinDisparities = 300;
  return disparities >= kMinDisparities && sigma[0] < kMaxSigma0;
}

bool DisparityCalibration::should_be_applied() const {
  constexpr double kMatters = 0.15;      // pixels: what the terms were seen to change from part to part
  constexpr double kMinCostFall = 0.01;  // less was seen only where nothing was wrong
  return determined() && rms_px > kMatters && cost_fall > kMinCostFall && halves_differ_px < 2 * rms_px;
}

DisparityCalibrator::DisparityCalibrator(const Rig& rig, const std::string& self_calibration,
                                         const Executor& executor)
    : rig_(rig),
      measures_(self_calibration != "off"),
      applies_(self_calibration == "auto"),
      executor_(executor) {}

bool DisparityCalibrator::is_due(const Map& map) const {
  return applies_ && map.keyframes().size() >= next_keyframes_;
}

DisparityField DisparityCalibrator::update(std::int32_t component, Map& map) {
  while (next_keyframes_ <= map.keyframes().size()) next_keyframes_ += next_keyframes_ / 2;
  if (!measures_) return DisparityField::Zero();
  Window window = whole_component(map, component);
  if (window.problem.observations.empty()) return DisparityField::Zero();
  const double cost_without = adjust_bundle(window.problem, {}, executor_).cost_after;
  FieldReport report = estimate_field(window.problem, applied_, executor_);
  take(report, window.problem);
  if (!result_.applied) judge(cost_without, report.bundle.cost_after, window.problem);
  if (!result_.applied) return DisparityField::Zero();
  const DisparityField rest = report.field - applied_;
  applied_ = report.field;
  map.correct_disparities(rest);
  std::fill(report.bundle.inlier.begin(), report.bundle.inlier.end(), char{1});  // the next adjustment judges
  apply_adjustment(window, report.bundle, map);
  return rest;
}

void DisparityCalibrator::take(const FieldReport& report, const BundleProblem& problem) {
  ++result_.estimates;
  result_.field = report.field;
  result_.sigma = kTooSure * report.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  result_.rms_px = rms_of(report.field, problem);
  result_.disparities = static_cast<std::int64_t>(report.disparities);
}

/// Decides whether the field is taken off from now on.
void DisparityCalibrator::judge(double cost_without, double cost_with, const BundleProblem& problem) {
  result_.cost_fall = cost_without > 0 ? std::max(0.0, 1 - cost_with / cost_without) : 0;
  const auto count = static_cast<std::int32_t>(problem.camera_fixed.size());
  BundleProblem first = part_of(problem, 0, count / 2), second = part_of(problem, count / 2, count);
  const DisparityField none = DisparityField::Zero();
  result_.halves_differ_px = 0;
  if (!result_.should_be_applied()) return;  // both halves take as long as the whole
  result_.halves_differ_px = rms_of(
      estimate_field(first, none, executor_).field - estimate_field(second, none, executor_).field, problem);
  result_.applied = applies_ && result_.should_be_applied();
}

void DisparityCalibrator::correct(ObservedFrame& frame) const {
  if (!applied_.isZero(0)) correct_disparities(rig_, applied_, frame);
}

}  // namespace cairn
