// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"

namespace cairn {

/// A frame found in the map without a prediction.
struct Relocalization {
  KeyframeId keyframe;  ///< that it was matched with
  FramePose tracked;
};

/// Tries the keyframes that look most like the frame, the last relocalization_keyframes and random_loops
/// others: matches descriptors, verifies by geometry (loop_min_inliers), takes the one with the most inliers
/// and refines its pose in the map around it. Deterministic at any number of threads.
[[nodiscard]] std::optional<Relocalization> relocalize(const IndexedMap& indexed,
                                                       const ObservedFrame& observed,
                                                       const SlamOptions& options, const Executor& executor);

/// `nearby` keyframes before `before` (itself excluded), nearest first, then `random` of all earlier ones,
/// drawn without replacement from (seed, stream). Erased ones are passed over.
[[nodiscard]] std::vector<KeyframeId> candidate_keyframes(const Map& map, KeyframeId before, int nearby,
                                                          int random, std::uint64_t seed,
                                                          std::uint64_t stream);

}  // namespace cairn
