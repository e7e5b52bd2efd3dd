// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/map/keyframe_map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/slam/options.h"

namespace cairn {

struct LoopReport {
  int tried = 0;
  int nearby = 0;  ///< edges to one of the last nearby_loops keyframes
  int far = 0;     ///< edges to one drawn at random
};

/// Tries the last keyframe of the map against nearby_loops keyframes before it and random_loops others, all
/// geometrically verified by estimate_motion and max_norm_lp, and adds an edge, flagged robust, for each that
/// holds. Pairs that have an edge already are left out. Deterministic at any number of threads.
LoopReport close_loops(const KeyframeMap& map, const RgbdSlamOptions& options, const Executor& executor,
                       std::vector<PoseGraph::Edge>& edges);

}  // namespace cairn
