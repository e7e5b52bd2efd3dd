// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "cairn/map/map.h"

namespace cairn {

/// A keyframe and how many of some landmarks it shows.
struct CovisibleKeyframe {
  KeyframeId keyframe;
  int shared = 0;
};

/// Keyframes that show any of the landmarks (invalid and erased ones are passed over), most first, of equal
/// ones the later first.
[[nodiscard]] std::vector<CovisibleKeyframe> keyframes_showing(const Map& map,
                                                               std::span<const LandmarkId> landmarks);

/// Keyframes that share at least `min_shared` landmarks with this one, most first; itself not.
[[nodiscard]] std::vector<CovisibleKeyframe> covisible_keyframes(const Map& map, KeyframeId id,
                                                                 int min_shared);

/// The `count` nearest neighbours of a keyframe: those that share at least 15 landmarks with it (Mur-Artal et
/// al. 2015), most first.
[[nodiscard]] std::vector<KeyframeId> neighbours_of(
    const Map& map, KeyframeId id, std::size_t count = std::numeric_limits<std::size_t>::max());

/// Whether a landmark is worth looking for: several keyframes show it, or the one that does is among the last
/// `trial_keyframes` + 1 of the map.
[[nodiscard]] bool is_on_trial_or_confirmed(const Map& map, LandmarkId landmark, int trial_keyframes);

/// The landmarks that these keyframes show and that are worth looking for, each once, increasing.
[[nodiscard]] std::vector<LandmarkId> landmarks_of(const Map& map, std::span<const KeyframeId> keyframes,
                                                   int trial_keyframes);

/// The neighbourhood of a view that shows `landmarks`: the `count` keyframes that show most of them, and each
/// of their `neighbours` nearest in shared landmarks. Increasing.
[[nodiscard]] std::vector<KeyframeId> local_keyframes(const Map& map, std::span<const LandmarkId> landmarks,
                                                      std::size_t count, std::size_t neighbours);

}  // namespace cairn
