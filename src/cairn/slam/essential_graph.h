// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/map/map.h"
#include "cairn/map/pose_graph.h"

namespace cairn {

/// Builds the essential graph of a component (Mur-Artal et al. 2015, sec. III-D). Vertices are the keyframes
/// that are not erased, at their present poses; the first one is fixed. Edges join each keyframe to its
/// parent and to those that share at least 100 landmarks with it, as their present poses have them, and are
/// the given `loops`, as measured. The nearest ancestor that is left stands for an erased keyframe.
[[nodiscard]] PoseGraph essential_graph(const Map& map, std::int32_t component,
                                        std::span<const PoseGraph::Edge> loops);

/// Computes the information of an edge between two keyframes that see one scene, in the order of
/// PoseGraph::Edge: a standard deviation of 4 mrad in rotation, and of 0.004 times the median depth of
/// `keyframe` in translation, at least 5 mm.
[[nodiscard]] Matrix6d edge_information(const Map& map, KeyframeId keyframe);

/// Moves the keyframes to the poses of the graph's vertices, and each landmark with the first keyframe that
/// shows it.
void move_to(const PoseGraph& graph, Map& map);

/// Moves all keyframes and landmarks of `component` by the rigid transform `into_from_component`, and assigns
/// them to component `into`.
void move_component(std::int32_t component, std::int32_t into, const Rigid3& into_from_component, Map& map);

}  // namespace cairn
