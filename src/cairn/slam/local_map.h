// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "cairn/map/map.h"

namespace cairn {

/// Holds a keyframe and how many of the landmarks in question it shows.
struct CovisibleKeyframe {
  KeyframeId keyframe;
  int shared = 0;
};

/// Returns the keyframes that show any of `landmarks`, by descending number; if equal, the later first.
/// Invalid and erased landmarks are ignored.
[[nodiscard]] std::vector<CovisibleKeyframe> keyframes_showing(const Map& map,
                                                               std::span<const LandmarkId> landmarks);

/// Returns the other keyframes that share at least `min_shared` landmarks with keyframe `id`, by descending
/// number.
[[nodiscard]] std::vector<CovisibleKeyframe> covisible_keyframes(const Map& map, KeyframeId id,
                                                                 int min_shared);

/// Returns the neighbours of a keyframe: the keyframes that share most landmarks with it, at least 15
/// (Mur-Artal et al. 2015), by descending number, at most `count`.
[[nodiscard]] std::vector<KeyframeId> neighbours_of(
    const Map& map, KeyframeId id, std::size_t count = std::numeric_limits<std::size_t>::max());

/// Returns whether a landmark is worth a search: several keyframes show it, or the only one that does is
/// among the last `trial_keyframes` + 1 of the map.
[[nodiscard]] bool is_on_trial_or_confirmed(const Map& map, LandmarkId landmark, int trial_keyframes);

/// Returns the landmarks that `keyframes` show and that are worth a search (is_on_trial_or_confirmed), each
/// once, in ascending order.
[[nodiscard]] std::vector<LandmarkId> landmarks_of(const Map& map, std::span<const KeyframeId> keyframes,
                                                   int trial_keyframes);

/// Returns the neighbourhood of a view that shows `landmarks`: the `count` keyframes that show most of them,
/// and the first `neighbours` neighbours (neighbours_of) of each. Each keyframe once, in ascending order.
[[nodiscard]] std::vector<KeyframeId> local_keyframes(const Map& map, std::span<const LandmarkId> landmarks,
                                                      std::size_t count, std::size_t neighbours);

}  // namespace cairn
