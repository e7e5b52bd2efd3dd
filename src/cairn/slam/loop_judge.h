// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/map/map.h"

namespace cairn {

/// Says that keyframe `current` shows the place that keyframe `candidate` shows.
struct LoopHypothesis {
  KeyframeId candidate, current;
  Rigid3 candidate_from_current;  ///< as measured from the features
  int inliers = 0;
  bool agrees = false;  ///< most observations of the loop fit the present poses as well
};

/// Says whether a loop is believed.
enum class LoopVerdict {
  agrees,       ///< the poses fit the loop already; landmarks may be fused
  unconfirmed,  ///< waits for another keyframe with the same correction
  implausible,  ///< the correction is larger than odometry can have drifted
  believed,     ///< confirmed by a second keyframe
};

/// Decides which loops are believed. A single recognised place may be wrong, however many features fit,
/// because rooms and facades repeat. So a loop that moves keyframes is believed only if a second keyframe, at
/// most 10 later, gives the same correction and if, within one component, odometry may have drifted by the
/// correction along the path between the two keyframes.
class LoopJudge {
 public:
  /// Judges a loop and keeps it, so that a later one can confirm it. To be called in the order of `current`.
  [[nodiscard]] LoopVerdict judge(const Map& map, const LoopHypothesis& loop);

 private:
  struct Pending {
    KeyframeId current;
    Rigid3 corrected_from_world;  // how the world near `current` would move
    std::int32_t component = 0;   // of `current`
    std::int32_t into = 0;        // of the candidate
  };
  std::optional<Pending> pending_;
};

/// Computes the length of the path from one keyframe to a later one, through the keyframes made in between in
/// their order, metres. Steps from one component to another are not counted.
[[nodiscard]] double path_length(const Map& map, KeyframeId from, KeyframeId to);

}  // namespace cairn
