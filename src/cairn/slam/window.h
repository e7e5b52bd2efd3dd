// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map/map.h"
#include "cairn/optimize/bundle_adjustment.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Holds a bundle adjustment of keyframes and landmarks of the map, with their ids.
struct Window {
  BundleProblem problem;
  std::vector<KeyframeId> cameras;  ///< keyframe of each camera of the problem
  std::vector<LandmarkId> points;   ///< landmark of each point of the problem
};

/// Builds the adjustment of a keyframe, of its window_keyframes - 1 neighbours with the most shared
/// landmarks, and of the landmarks that these show. The window_fixed other keyframes that show most of the
/// landmarks are held fixed; without any, the oldest keyframe is.
[[nodiscard]] Window window_around(const Map& map, KeyframeId keyframe, const MappingOptions& options);

/// Returns the component with the most keyframes, the first of several; 0 in an empty map.
[[nodiscard]] std::int32_t largest_component(const Map& map);

/// Builds the adjustment of all keyframes of a component, the first one held fixed, and of all their
/// landmarks that are seen at least twice.
[[nodiscard]] Window whole_component(const Map& map, std::int32_t component);

/// Moves keyframes and landmarks to their adjusted poses and points, and removes the observations that do not
/// agree with them; of those that agree in their pixel (Agreement) only the disparity.
void apply_adjustment(const Window& window, const BundleReport& report, Map& map);

}  // namespace cairn
