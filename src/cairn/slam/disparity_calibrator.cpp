// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/disparity_calibrator.h"

#include <algorithm>

#include "cairn/slam/window.h"

namespace cairn {

DisparityCalibrator::DisparityCalibrator(const Rig& rig, const StereoNoise& noise, const Executor& executor)
    : rig_(rig),
      measures_(noise.self_calibration != "off"),
      applies_(noise.self_calibration == "auto"),
      min_sigmas_(noise.min_disparity_sigmas),
      executor_(executor) {}

bool DisparityCalibrator::is_due(const Map& map) const {
  return applies_ && map.keyframes().size() >= next_keyframes_;
}

std::optional<DisparityField> DisparityCalibrator::update(Map& map) {
  while (next_keyframes_ <= map.keyframes().size()) next_keyframes_ += next_keyframes_ / 2;
  if (!measures_) return std::nullopt;
  Window window = whole_component(map, largest_component(map));
  if (window.problem.observations.empty()) return std::nullopt;
  if (const auto report = estimate(window.problem)) return take_off(*report, window, map);
  return std::nullopt;
}

/// Estimates the field. Returns nullopt if it is not to be applied.
std::optional<FieldReport> DisparityCalibrator::estimate(BundleProblem& problem) {
  DisparityCalibration found = result_;
  const double cost_without = found.applied ? 0 : adjusted_cost(problem, executor_);
  FieldReport report = estimate_field(problem, applied_, executor_, found);
  if (result_.applied && !found.is_determined()) return std::nullopt;  // what was known before is better
  if (!found.applied) {
    judge_field(problem, cost_without, report.bundle.cost_after, executor_, found);
    found.applied = applies_ && found.should_be_applied();
  }
  result_ = found;
  return found.applied ? std::optional(std::move(report)) : std::nullopt;
}

DisparityField DisparityCalibrator::take_off(const FieldReport& report, const Window& adjusted, Map& map) {
  DisparityField rest = report.field - applied_;
  applied_ = report.field;
  BundleReport without_outliers = report.bundle;  // the next adjustment judges
  std::fill(without_outliers.inlier.begin(), without_outliers.inlier.end(), char{1});
  apply_adjustment(adjusted, without_outliers, map);
  map.correct_disparities(rest, min_sigmas_);
  return rest;
}

void DisparityCalibrator::correct(ObservedFrame& frame) const {
  if (!applied_.isZero(0)) correct_disparities(rig_, applied_, min_sigmas_, frame);
}

}  // namespace cairn
