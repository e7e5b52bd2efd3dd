// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/pose_graph.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"

namespace cairn {
namespace {

TEST(PoseGraph, FlagsEdgesThatAreNotOdometry) {
  PoseGraph graph;
  for (const int id : {10, 20, 30}) graph.vertices.push_back({id, {}});
  const auto edge = [](std::int64_t a, std::int64_t b) {
    return PoseGraph::Edge{a, b, {}, Matrix6d::Identity(), false};
  };
  graph.edges = {edge(10, 20), edge(30, 20), edge(10, 30), edge(30, 10)};
  EXPECT_EQ(flag_loop_edges_robust(graph), 2U);
  EXPECT_FALSE(graph.edges[0].robust);
  EXPECT_FALSE(graph.edges[1].robust);
  EXPECT_TRUE(graph.edges[2].robust);
  EXPECT_TRUE(graph.edges[3].robust);
}

TEST(PoseGraph, RejectsDoubleIdsAndUnknownVertices) {
  PoseGraph graph;
  graph.vertices = {{1, {}}, {1, {}}};
  EXPECT_THROW((void)vertex_positions(graph), PreconditionError);
  graph.vertices = {{1, {}}};
  graph.edges = {{1, 2, {}, Matrix6d::Identity(), false}};
  EXPECT_THROW(flag_loop_edges_robust(graph), PreconditionError);
}

TEST(PoseGraph, InformationWeighsHalfTheRotationVector) {
  const Matrix6d information = information_from_std(0.1, 0.02);
  Vector6d error;
  error << 0.1, 0, 0, rotation_exp({0.02, 0, 0}).vec();  // one standard deviation each
  EXPECT_NEAR(error.dot(information * error), 2.0, 1e-4);
  EXPECT_THROW((void)information_from_std(0.0, 1.0), PreconditionError);
}

}  // namespace
}  // namespace cairn
