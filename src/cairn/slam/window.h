// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map/map.h"
#include "cairn/optimize/bundle_adjustment.h"
#include "cairn/slam/options.h"

namespace cairn {

/// A component of the map as a bundle adjustment, and what came of which.
struct Window {
  BundleProblem problem;
  std::vector<KeyframeId> cameras;  ///< one per camera of the problem
  std::vector<LandmarkId> points;   ///< one per point
};

/// The keyframe, its window_keyframes - 1 neighbours with the most shared landmarks, and all landmarks that
/// they show; window_fixed other keyframes that show these hold them in place. The oldest keyframe is held
/// where no other is.
[[nodiscard]] Window window_around(const Map& map, KeyframeId keyframe, const MappingOptions& options);

/// All keyframes of a component, the first one held, and all their landmarks seen at least twice.
[[nodiscard]] Window whole_component(const Map& map, std::int32_t component);

/// Takes the adjusted places over and ends the observations that do not agree with them.
void apply_adjustment(const Window& window, const BundleReport& report, Map& map);

}  // namespace cairn
