// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/slam/tracker.h"

namespace cairn {

/// What each tracked frame saw of the map, kept small, so that its pose can be solved for once more when the
/// map is at its best.
class FrameMemory {
 public:
  /// The frame at position `index` of the run's frames.
  void remember(std::size_t index, const ObservedFrame& observed, const FramePose& tracked);

  /// Solves for the poses of the remembered frames that are no keyframes any more, in the map as it is now. A
  /// frame keeps its place by its keyframe where too few of its landmarks are left or agree. Deterministic at
  /// any number of threads.
  void refine(const Map& map, const SlamOptions& options, const Executor& executor,
              std::vector<TrackingResult>& frames) const;

 private:
  struct RememberedObservation {
    LandmarkId landmark;
    float u = 0, v = 0, d = 0, sigma_px = 0, sigma_d_px = 0;
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
