// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/id.h"
#include "cairn/map/pose_graph.h"
#include "cairn/slam/motion.h"

namespace cairn {

/// The pose-graph edge that a motion measures; vertex ids are keyframe ids. The features' errors are not
/// independent (depth calibration, registration and rolling shutter act on all at once), so the inverse of
/// the motion's information is widened by a floor on the standard deviations before it becomes the edge's
/// information.
[[nodiscard]] PoseGraph::Edge make_edge(KeyframeId reference, KeyframeId current, const Motion& motion,
                                        bool loop);

}  // namespace cairn
