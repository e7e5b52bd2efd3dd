// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/map/map.h"

namespace cairn {

/// Keyframe `current` was recognised as a view of what `candidate` saw.
struct LoopHypothesis {
  KeyframeId candidate, current;
  Rigid3 candidate_from_current;  ///< as the features say
  int inliers = 0;
  bool agrees = false;  ///< with where the map has the two already, to the pixel
};

enum class LoopVerdict {
  agrees,       ///< nothing to bend: landmarks may be joined
  unconfirmed,  ///< wait for another keyframe that says the same
  implausible,  ///< odometry is never that wrong
  believed,
};

/// Decides which loops are believed. One recognised place may be a wrong one, however many features fit:
/// rooms and facades repeat themselves. So a loop that bends the map is believed when a second keyframe, near
/// the first, gives the same correction, and when the correction is one that the odometry may have drifted by
/// along the way between the two.
class LoopJudge {
 public:
  [[nodiscard]] LoopVerdict judge(const Map& map, const LoopHypothesis& loop);

 private:
  struct Pending {
    KeyframeId current;
    Rigid3 corrected_from_world;  // how the world near `current` would move
    std::int32_t component = 0;   // it is in
    std::int32_t into = 0;        // and would move into
  };
  std::optional<Pending> pending_;
};

/// Length of the way from one keyframe to a later one, through those made between in their order, metres.
/// Steps between components count nothing.
[[nodiscard]] double path_length(const Map& map, KeyframeId from, KeyframeId to);

}  // namespace cairn
