// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/slam/tracker.h"

namespace cairn {

/// Stores the observations of landmarks of each tracked frame, in single precision, so that its pose can be
/// solved again when the map is complete.
class FrameMemory {
 public:
  /// Stores the observations of a frame; `index` is its position in the `frames` given to refine().
  void remember(std::size_t index, const ObservedFrame& observed, const FramePose& tracked);

  /// Takes a field off the disparities of all stored observations (correct_disparity).
  void correct_disparities(const Rig& rig, const DisparityField& field, double min_sigmas);

  /// Sets the standard deviations of all stored disparities to those of `noise`.
  void weigh_disparities(const Rig& rig, const DisparityNoise& noise);

  /// Solves again for the poses of the stored frames that are not keyframes, in the map as it is now. A frame
  /// keeps its pose relative to its keyframe if fewer than min_inliers of its landmarks, or fewer than half
  /// of those that are still in the map, agree. Deterministic at any number of threads.
  void refine(const Map& map, const SlamOptions& options, const Executor& executor,
              std::vector<TrackingResult>& frames) const;

 private:
  struct RememberedObservation {
    LandmarkId landmark;
    float u = 0, v = 0, d = 0, sigma_px = 0, sigma_d_px = 0;

    [[nodiscard]] Observation observation() const {
      return {static_cast<double>(u), static_cast<double>(v), static_cast<double>(d),
              static_cast<double>(sigma_px), static_cast<double>(sigma_d_px)};
    }
  };
  struct Remembered {
    std::size_t index = 0;
    std::vector<RememberedObservation> seen;
  };
  static void refine_one(const Map& map, const SlamOptions& options, const Remembered& remembered,
                         TrackingResult& track);

  std::vector<Remembered> frames_;
};

}  // namespace cairn
