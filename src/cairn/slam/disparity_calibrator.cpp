// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/disparity_calibrator.h"

#include <algorithm>

#include "cairn/slam/window.h"

namespace cairn {

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
  FieldReport report = estimate_field(window.problem, applied_, executor_, result_);
  if (!result_.applied) {
    judge_field(window.problem, cost_without, report.bundle.cost_after, executor_, result_);
    result_.applied = applies_ && result_.should_be_applied();
  }
  if (!result_.applied) return DisparityField::Zero();
  const DisparityField rest = report.field - applied_;
  applied_ = report.field;
  map.correct_disparities(rest);
  std::fill(report.bundle.inlier.begin(), report.bundle.inlier.end(), char{1});  // the next adjustment judges
  apply_adjustment(window, report.bundle, map);
  return rest;
}

void DisparityCalibrator::correct(ObservedFrame& frame) const {
  if (!applied_.isZero(0)) correct_disparities(rig_, applied_, frame);
}

}  // namespace cairn
