// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cairn/slam/slam.h"

namespace cairn {

/// Holds how many frames of a run had which outcome.
struct FrameCounts {
  std::int64_t frames = 0;       ///< decoded
  std::int64_t tracked = 0;      ///< in the main component of the map
  std::int64_t elsewhere = 0;    ///< tracked in another component
  std::int64_t relocalized = 0;  ///< found again after being lost
  std::int64_t too_far = 0, not_matched = 0;
  int median_inliers = 0;  ///< of tracked frames; 0 of none
};

/// Counts the frames of a run by what became of them.
[[nodiscard]] FrameCounts count_frames(const SlamResult& result);

/// Returns the stages with their names and seconds, in the order of the data. They point into `times`.
[[nodiscard]] std::vector<std::pair<const char*, const std::vector<double>*>> stages(const StageTimes& times);

/// Returns whether the camera was found in the map that the run started from.
[[nodiscard]] bool is_start_found(const SlamResult& result);

}  // namespace cairn
