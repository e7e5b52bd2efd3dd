// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/map/map.h"
#include "cairn/map/pose_graph.h"

namespace cairn {

/// The keyframes of a component, not erased, as vertices where they are now; edges from each to its parent,
/// and between those that share many landmarks, as their places say now; and the loops given (Mur-Artal et
/// al. 2015, sec. III-D). A loop with an erased keyframe goes to the parent that is left, which knows where
/// it was. The first keyframe is fixed.
[[nodiscard]] PoseGraph essential_graph(const Map& map, std::int32_t component,
                                        std::span<const PoseGraph::Edge> loops);

/// The information of an edge between two keyframes that see one scene: some milliradians, and as much of the
/// scene's depth.
[[nodiscard]] Matrix6d edge_information(const Map& map, KeyframeId keyframe);

/// Moves the keyframes to the vertices' places, and each landmark with the first keyframe that shows it.
void move_to(const PoseGraph& graph, Map& map);

/// Moves all keyframes and landmarks of a component by a rigid transform, into another component.
void move_component(std::int32_t component, std::int32_t into, const Rigid3& into_from_component, Map& map);

}  // namespace cairn
