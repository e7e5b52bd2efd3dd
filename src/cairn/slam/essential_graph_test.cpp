// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/essential_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;

Pairs pairs_of(const PoseGraph& graph) {
  Pairs pairs;
  for (const PoseGraph::Edge& edge : graph.edges) pairs.emplace(edge.a, edge.b);
  return pairs;
}

Rigid3 place(double k) {
  return {rotation_exp({0, 0.2 * k, 0.1}), {k, 0.5 * k, 0}};
}

/// Five keyframes, each with a landmark of its own and the one before as its parent; 0 and 3 share 100.
Map five_keyframes() {
  constexpr std::int32_t kShared = 100;
  Map map(testkit::kWorldRig, "ORB");
  for (std::int32_t k = 0; k < 5; ++k) {
    const KeyframeId id = map.add_keyframe(testkit::blank_frame(kShared + 1), place(k), {k - 1}, 0);
    (void)map.add_landmark(place(k) * Eigen::Vector3d(0, 0, 2), {id, kShared});
  }
  for (std::int32_t i = 0; i < kShared; ++i) {
    const LandmarkId shared = map.add_landmark({0, 0, 0}, {{0}, i});
    map.add_observation(shared, {{3}, i});
  }
  return map;
}

PoseGraph::Edge loop_between(std::int64_t a, std::int64_t b) {
  return {a, b, testkit::aside(1), Matrix6d::Identity(), false};
}

TEST(EssentialGraph, joins_parents_and_keyframes_that_share_much) {
  const PoseGraph graph = essential_graph(five_keyframes(), 0, {});
  EXPECT_EQ(graph.vertices.size(), 5U);
  EXPECT_EQ(pairs_of(graph), (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 3}}));
  EXPECT_EQ(graph.edges.size(), 5U) << "each once";
  EXPECT_EQ(graph.fixed, (std::vector<std::int64_t>{0}));
}

TEST(EssentialGraph, sharing_less_makes_no_edge) {
  Map map = five_keyframes();
  map.remove_observation(map[KeyframeId{3}].landmarks[0], {3});
  EXPECT_EQ(pairs_of(essential_graph(map, 0, {})).count({0, 3}), 0U);
}

TEST(EssentialGraph, its_edges_say_what_the_map_says) {
  const PoseGraph graph = essential_graph(five_keyframes(), 0, {});
  EXPECT_FALSE(graph.edges.empty());
  for (const PoseGraph::Edge& edge : graph.edges) {
    const Rigid3 expected = place(static_cast<double>(edge.a)).inverse() * place(static_cast<double>(edge.b));
    EXPECT_LT(motion_norm(expected.inverse() * edge.a_from_b), 1e-12);
  }
}

TEST(EssentialGraph, an_erased_keyframe_leaves_its_children_to_its_parent) {
  Map map = five_keyframes();
  map.erase(KeyframeId{1});
  map.erase(KeyframeId{2});
  const PoseGraph graph = essential_graph(map, 0, {});
  EXPECT_EQ(graph.vertices.size(), 3U);
  EXPECT_EQ(pairs_of(graph), (Pairs{{0, 3}, {3, 4}}));
}

TEST(EssentialGraph, keeps_to_its_component_and_to_loops_within) {
  Map map = five_keyframes();
  const KeyframeId other = map.add_keyframe(testkit::blank_frame(1), {}, {}, 1);
  const std::vector<PoseGraph::Edge> loops = {loop_between(1, other.value), loop_between(0, 4)};
  const PoseGraph graph = essential_graph(map, 0, loops);
  EXPECT_EQ(pairs_of(graph), (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 3}, {0, 4}}));
  EXPECT_EQ(graph.edges.back().a_from_b.translation.x(), 1) << "the loop as measured";
}

TEST(EssentialGraph, a_loop_of_an_erased_keyframe_goes_to_its_parent) {
  Map map = five_keyframes();
  const Rigid3 one_from_two = map.world_from_camera({1}).inverse() * map.world_from_camera({2});
  map.erase(KeyframeId{2});
  const PoseGraph::Edge loop = loop_between(2, 4);
  const PoseGraph::Edge edge = essential_graph(map, 0, {{loop}}).edges.back();
  EXPECT_EQ(std::pair(edge.a, edge.b), std::pair(std::int64_t{1}, std::int64_t{4}));
  EXPECT_LT(motion_norm(edge.a_from_b.inverse() * one_from_two * loop.a_from_b), 1e-12);
}

TEST(EssentialGraph, of_a_component_without_keyframes_is_empty) {
  const PoseGraph graph = essential_graph(five_keyframes(), 1, {});
  EXPECT_TRUE(graph.vertices.empty() && graph.edges.empty() && graph.fixed.empty());
}

TEST(EdgeInformation, knows_less_of_far_scenes) {
  Map map(testkit::kWorldRig, "ORB");
  for (const double depth : {1.0, 4.0}) {
    ObservedFrame observed = testkit::blank_frame(1);
    observed.points_in_camera[0] = {0, 0, depth};
    (void)map.add_keyframe(std::move(observed), {}, {}, 0);
  }
  const KeyframeId without_depth = map.add_keyframe(testkit::blank_frame(1), {}, {}, 0);
  EXPECT_GT(edge_information(map, {0})(0, 0), 5 * edge_information(map, {1})(0, 0));
  EXPECT_EQ(edge_information(map, {0})(3, 3), edge_information(map, {1})(3, 3));
  EXPECT_TRUE(edge_information(map, without_depth).allFinite());
}

TEST(MoveTo, landmarks_go_with_the_first_keyframe_that_shows_them) {
  Map map = five_keyframes();
  const LandmarkId of_first{5}, of_fourth{3};
  const Eigen::Vector3d before = map[of_first].point_in_world;
  PoseGraph graph = essential_graph(map, 0, {});
  const Rigid3 fourth{rotation_exp({0.3, 0, 0}), {4, 4, 4}};
  graph.vertices[3].world_from_vertex = fourth;
  move_to(graph, map);
  EXPECT_LT(motion_norm(map[KeyframeId{3}].world_from_camera.inverse() * fourth), 1e-12);
  EXPECT_LT((map[of_fourth].point_in_world - fourth * Eigen::Vector3d(0, 0, 2)).norm(), 1e-12);
  EXPECT_LT((map[of_first].point_in_world - before).norm(), 1e-12);
}

TEST(MoveTo, keeps_landmarks_of_other_components) {
  Map map = five_keyframes();
  const KeyframeId other = map.add_keyframe(testkit::blank_frame(1), place(9), {}, 1);
  const LandmarkId landmark = map.add_landmark({1, 2, 3}, {other, 0});
  PoseGraph graph = essential_graph(map, 0, {});
  for (auto& vertex : graph.vertices) vertex.world_from_vertex.translation.z() += 1;
  move_to(graph, map);
  EXPECT_LT((map[landmark].point_in_world - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

TEST(MoveComponent, moves_all_of_a_component_into_another) {
  Map map = five_keyframes();
  const KeyframeId other = map.add_keyframe(testkit::blank_frame(2), place(9), {}, 1);
  const KeyframeId erased = map.add_keyframe(testkit::blank_frame(2), place(10), other, 1);
  const LandmarkId landmark = map.add_landmark({1, 2, 3}, {other, 0});
  const Eigen::Vector3d kept = map[LandmarkId{0}].point_in_world;
  map.erase(erased);
  const Rigid3 into_from_component{rotation_exp({0, 0, 1}), {1, 1, 1}};
  move_component(1, 0, into_from_component, map);
  EXPECT_LT(motion_norm(map[other].world_from_camera.inverse() * into_from_component * place(9)), 1e-12);
  EXPECT_LT(motion_norm(map.world_from_camera(erased).inverse() * into_from_component * place(10)), 1e-12);
  EXPECT_LT((map[landmark].point_in_world - into_from_component * Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_EQ(map.component_of(other), 0);
  EXPECT_EQ(map.component_of(erased), 0);
  EXPECT_EQ(map[LandmarkId{0}].point_in_world, kept);
  EXPECT_LT(motion_norm(map[KeyframeId{4}].world_from_camera.inverse() * place(4)), 1e-12);
}

}  // namespace
}  // namespace cairn
