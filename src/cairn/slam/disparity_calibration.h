// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/core/executor.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/map/map.h"
#include "cairn/optimize/bundle_adjustment.h"
#include "cairn/slam/window.h"

namespace cairn {

/// Holds what the map says of the field of a stereo pair's disparities, and what was done about it.
struct DisparityCalibration {
  DisparityField field = DisparityField::Zero();  ///< what was found, in all, pixels
  /// Standard deviations of its terms, pixels: ten times the formal ones, as parts of a recording differ.
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();
  double rms_px = 0;     ///< of the field over the disparities
  double cost_fall = 0;  ///< share of the adjustment's cost that the field explains
  /// Root mean square over the disparities of the difference between the fields of both halves of the map.
  double halves_differ_px = 0;
  std::int64_t disparities = 0;  ///< disparities that it was estimated from; 0: it was not
  int estimates = 0;             ///< how often it was estimated
  bool applied = false;          ///< whether it was taken off all disparities

  /// Returns whether the recording determines the field: enough disparities, which move it.
  [[nodiscard]] bool determined() const;
  /// Returns whether it is determined, explains what does not fit, is large enough to matter, and both halves
  /// of the map agree that it is there.
  [[nodiscard]] bool should_be_applied() const;
};

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
  void take(const FieldReport& report, const BundleProblem& problem);
  void judge(double cost_without, double cost_with, const BundleProblem& problem);

  Rig rig_;
  bool measures_, applies_;
  const Executor& executor_;
  DisparityCalibration result_;
  DisparityField applied_ = DisparityField::Zero();
  std::size_t next_keyframes_ = 12;
};

}  // namespace cairn
