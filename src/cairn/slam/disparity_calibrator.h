// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/core/executor.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/map/map.h"
#include "cairn/optimize/disparity_calibration.h"

namespace cairn {

/// Estimates the field of the disparities of a stereo pair while the map grows, and takes it off: a few
/// columns that all disparities share in the adjustment of the whole component (adjust_bundle_with_field).
/// Disparities that are too small by half a pixel make a street of 40 m seem 5 % longer, and the motion along
/// it; no other parameter of a map can take that up.
class DisparityCalibrator {
 public:
  /// `self_calibration` is that of StereoNoise; nothing is done with "off".
  DisparityCalibrator(const Rig& rig, const std::string& self_calibration, const Executor& executor);

  /// Returns whether the map has so many keyframes that an estimate is due: 12, and each time half as many
  /// more.
  [[nodiscard]] bool is_due(const Map& map) const;
  /// Estimates the field from the keyframes of a component. If it is to be applied, takes what is new of it
  /// off the map's disparities and moves keyframes and landmarks to their places without it. Returns what was
  /// taken off; zero if the map was not changed. No adjustment of the map may be running.
  DisparityField update(std::int32_t component, Map& map);
  /// Takes what was found so far off the disparities of a frame that was observed without it.
  void correct(ObservedFrame& frame) const;

  [[nodiscard]] const DisparityCalibration& result() const { return result_; }

 private:
  Rig rig_;
  bool measures_, applies_;
  const Executor& executor_;
  DisparityCalibration result_;
  DisparityField applied_ = DisparityField::Zero();
  std::size_t next_keyframes_ = 12;
};

}  // namespace cairn
