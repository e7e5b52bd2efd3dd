// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_structure.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"

namespace cairn {
namespace {

PoseGraph::Edge edge(std::int64_t a, std::int64_t b) {
  return {a, b, {}, Matrix6d::Identity(), false};
}

/// Vertices 0..6; parts {0, 2, 4}, {1, 3}, {5}, {6}.
PoseGraph graph_of_four_parts() {
  PoseGraph graph;
  for (int id = 0; id < 7; ++id) graph.vertices.push_back({id, {}});
  graph.edges = {edge(4, 2), edge(3, 1), edge(0, 4)};
  return graph;
}

TEST(PoseGraphStructure, HoldsTheFirstVertexOfEachPart) {
  const PoseGraphStructure structure = analyse_pose_graph(graph_of_four_parts());
  EXPECT_EQ(structure.components, 4);
  EXPECT_EQ(structure.held, (std::vector<bool>{true, true, false, false, false, true, true}));
  EXPECT_EQ(structure.ends[0].a, 4U);
  EXPECT_EQ(structure.ends[0].b, 2U);
}

TEST(PoseGraphStructure, HoldsFixedVerticesInstead) {
  PoseGraph graph = graph_of_four_parts();
  graph.fixed = {2, 4};
  const PoseGraphStructure structure = analyse_pose_graph(graph);
  EXPECT_EQ(structure.held, (std::vector<bool>{false, true, true, false, true, true, true}));
}

TEST(PoseGraphStructure, RejectsABrokenGraph) {
  PoseGraph unknown_vertex = graph_of_four_parts();
  unknown_vertex.edges.push_back(edge(0, 9));
  EXPECT_THROW((void)analyse_pose_graph(unknown_vertex), PreconditionError);
  PoseGraph to_itself = graph_of_four_parts();
  to_itself.edges.push_back(edge(3, 3));
  EXPECT_THROW((void)analyse_pose_graph(to_itself), PreconditionError);
  PoseGraph unknown_fixed = graph_of_four_parts();
  unknown_fixed.fixed = {9};
  EXPECT_THROW((void)analyse_pose_graph(unknown_fixed), PreconditionError);
}

}  // namespace
}  // namespace cairn
