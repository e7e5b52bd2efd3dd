// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/essential_graph.h"

#include <algorithm>
#include <cmath>

#include "cairn/slam/local_map.h"

namespace cairn {
namespace {

constexpr int kManyShared = 100;  // landmarks

PoseGraph::Edge edge_as_placed(const Map& map, KeyframeId a, KeyframeId b) {
  const Rigid3 a_from_b = map[a].world_from_camera.inverse() * map[b].world_from_camera;
  return {a.value, b.value, a_from_b, edge_information(map, b), false};
}

/// Returns the nearest ancestor that is not erased.
KeyframeId living_parent(const Map& map, KeyframeId id) {
  KeyframeId parent = map[id].parent;
  while (parent.valid() && map[parent].erased) parent = map[parent].parent;
  return parent;
}

void add_edges(const Map& map, KeyframeId id, PoseGraph& graph) {
  const KeyframeId parent = living_parent(map, id);
  if (parent.valid()) graph.edges.push_back(edge_as_placed(map, parent, id));
  for (const CovisibleKeyframe& view : covisible_keyframes(map, id, kManyShared)) {
    if (view.keyframe < id && view.keyframe != parent)
      graph.edges.push_back(edge_as_placed(map, view.keyframe, id));
  }
}

KeyframeId keyframe_of(std::int64_t vertex) {
  return {static_cast<std::int32_t>(vertex)};
}

std::int32_t component_of(const Map& map, std::int64_t vertex) {
  return map[keyframe_of(vertex)].component;
}

/// Returns the edge with each erased keyframe replaced by its nearest ancestor that is left.
PoseGraph::Edge between_living(const Map& map, const PoseGraph::Edge& edge) {
  const KeyframeId a = keyframe_of(edge.a), b = keyframe_of(edge.b);
  const KeyframeId living_a = map[a].erased ? living_parent(map, a) : a;
  const KeyframeId living_b = map[b].erased ? living_parent(map, b) : b;
  const Rigid3 living_a_from_a = map.world_from_camera(living_a).inverse() * map.world_from_camera(a);
  const Rigid3 b_from_living_b = map.world_from_camera(b).inverse() * map.world_from_camera(living_b);
  return {living_a.value, living_b.value, living_a_from_a * edge.a_from_b * b_from_living_b, edge.information,
          edge.robust};
}

}  // namespace

Matrix6d edge_information(const Map& map, KeyframeId keyframe) {
  // With these the loop edges of a real Kinect recording cost about as much as they have degrees of freedom.
  constexpr double kRotationStd = 0.004;  // radians: 2 px at 525 px focal length
  constexpr double kMinTranslationStd = 0.005;
  constexpr double kUnknownDepth = 10;  // metres: careful in a room, usual in a street
  const double depth = median_depth(map[keyframe].observed);
  const double translation_std = kRotationStd * (std::isfinite(depth) ? depth : kUnknownDepth);
  return information_from_std(std::max(kMinTranslationStd, translation_std), kRotationStd);
}

PoseGraph essential_graph(const Map& map, std::int32_t component, std::span<const PoseGraph::Edge> loops) {
  PoseGraph graph;
  for (const KeyframeId id : map.keyframe_ids()) {
    if (map[id].component != component) continue;
    graph.vertices.push_back({id.value, map[id].world_from_camera});
    add_edges(map, id, graph);
  }
  for (const PoseGraph::Edge& loop : loops) {
    const PoseGraph::Edge edge = between_living(map, loop);
    if (edge.a != edge.b && component_of(map, edge.a) == component && component_of(map, edge.b) == component)
      graph.edges.push_back(edge);
  }
  if (!graph.vertices.empty()) graph.fixed = {graph.vertices.front().id};
  return graph;
}

void move_to(const PoseGraph& graph, Map& map) {
  std::vector<Rigid3> new_from_old(map.keyframes().size());
  for (const PoseGraph::Vertex& vertex : graph.vertices) {
    const KeyframeId id{static_cast<std::int32_t>(vertex.id)};
    new_from_old[static_cast<std::size_t>(id.value)] =
        vertex.world_from_vertex * map[id].world_from_camera.inverse();
    map.move(id, vertex.world_from_vertex);
  }
  for (const LandmarkId id : map.landmark_ids()) {
    const auto keyframe = static_cast<std::size_t>(map[id].observations.front().keyframe.value);
    map.move(id, new_from_old[keyframe] * map[id].point_in_world);
  }
}

void move_component(std::int32_t component, std::int32_t into, const Rigid3& into_from_component, Map& map) {
  for (const LandmarkId id : map.landmark_ids()) {
    if (map[map[id].observations.front().keyframe].component == component)
      map.move(id, into_from_component * map[id].point_in_world);
  }
  for (const KeyframeId id : map.keyframe_ids()) {
    if (map[id].component != component) continue;
    map.move(id, into_from_component * map[id].world_from_camera);
    map.set_component(id, into);
  }
}

}  // namespace cairn
