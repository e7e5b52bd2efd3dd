// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"

namespace cairn {

/// Holds the pose of a frame that was found in the map without a prediction.
struct Relocalization {
  KeyframeId keyframe;  ///< keyframe that the frame was matched with
  FramePose tracked;
};

/// Searches the map for a frame without a prediction. Tries the place_loops keyframes that look most like it,
/// the last relocalization_keyframes and random_loops others; verifies each by geometry (verify_place); takes
/// the one with the most inliers and refines the pose in the map around it. Returns nullopt if none is
/// verified. Deterministic at any number of threads.
[[nodiscard]] std::optional<Relocalization> relocalize(const IndexedMap& indexed,
                                                       const ObservedFrame& observed,
                                                       const SlamOptions& options, const Executor& executor);

/// Returns the last `nearby` keyframes before keyframe `before`, nearest first, then `random` earlier ones,
/// drawn without replacement by (seed, stream). Erased keyframes are left out.
[[nodiscard]] std::vector<KeyframeId> candidate_keyframes(const Map& map, KeyframeId before, int nearby,
                                                          int random, std::uint64_t seed,
                                                          std::uint64_t stream);

}  // namespace cairn
