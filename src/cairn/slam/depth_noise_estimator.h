// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/geometry/disparity_noise.h"
#include "cairn/map/map.h"
#include "cairn/observe/observer.h"
#include "cairn/optimize/disparity_noise_estimate.h"

namespace cairn {

/// Estimates the noise of a depth camera while the map grows, from the residuals of its depths against the
/// adjusted landmarks, and weighs all disparities by it. Begins cautious: a depth that is believed too much
/// throws right matches away, one that is believed too little costs some precision.
class DepthNoiseEstimator {
 public:
  /// Begins with the noise that is stated, and then keeps it, else with that of a map that the run continues,
  /// else with a cautious one.
  DepthNoiseEstimator(const Map& map, const DepthNoise& stated);

  /// Returns whether the map has so many keyframes that an estimate is due: 3, and each time half as many
  /// more.
  [[nodiscard]] bool is_due(const Map& map) const;
  /// Estimates the noise from the whole map and weighs the map's disparities by it. Returns the noise, or
  /// nullopt if the map does not show it. No adjustment of the map may be running.
  std::optional<DisparityNoise> update(Map& map);
  /// Makes the last estimate, and states in the map's header the noise that its disparities are weighed by.
  /// Returns that noise. To be called after the last frame; no adjustment of the map may be running.
  DisparityNoise finish(Map& map);
  /// Weighs the disparities of a frame by what is known so far.
  void weigh(ObservedFrame& frame) const;

  /// Returns the last estimate; before it, and if the noise is stated, what it began with and no disparities.
  [[nodiscard]] const DisparityNoiseEstimate& result() const { return result_; }

 private:
  bool is_estimated_;
  DisparityNoiseEstimate result_;
  std::size_t next_keyframes_ = 3;
};

}  // namespace cairn
