// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/core/executor.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/map/map.h"
#include "cairn/observe/observer.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/slam/window.h"

namespace cairn {

/// Estimates the field of the disparities of a stereo pair while the map grows, and takes it off: a few
/// columns that all disparities share in the adjustment of the whole component (adjust_bundle_with_field).
/// Disparities that are too small by half a pixel make a street of 40 m seem 5 % longer, and the motion along
/// it; no other parameter of a map can take that up.
class DisparityCalibrator {
 public:
  /// Does nothing if `noise` has self-calibration off.
  DisparityCalibrator(const Rig& rig, const StereoNoise& noise, const Executor& executor);

  /// Returns whether the map has so many keyframes that an estimate is due: 12, and each time half as many
  /// more.
  [[nodiscard]] bool is_due(const Map& map) const;
  /// Estimates the field from the component with the most keyframes. If it is to be applied, takes what is
  /// new of it off the map's disparities and moves keyframes and landmarks to their places without it.
  /// Returns what was taken off; nullopt if the map was not changed. No adjustment of the map may be running.
  std::optional<DisparityField> update(Map& map);
  /// Takes what was found so far off the disparities of a frame that was observed without it.
  void correct(ObservedFrame& frame) const;

  [[nodiscard]] const DisparityCalibration& result() const { return result_; }

 private:
  [[nodiscard]] std::optional<FieldReport> estimate(BundleProblem& problem);
  DisparityField take_off(const FieldReport& report, const Window& adjusted, Map& map);

  Rig rig_;
  bool measures_, applies_;
  double min_sigmas_;  // that a disparity has at least
  const Executor& executor_;
  DisparityCalibration result_;
  DisparityField applied_ = DisparityField::Zero();
  std::size_t next_keyframes_ = 12;
};

}  // namespace cairn
