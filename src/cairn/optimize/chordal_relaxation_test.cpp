// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/chordal_relaxation.h"

#include <gtest/gtest.h>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// A ring of 20 poses with exact measurements and one chord; given poses are all the identity but the first.
PoseGraph exact_ring(std::vector<Rigid3>& truth) {
  Random random(7);
  PoseGraph graph;
  for (int id = 0; id < 20; ++id) {
    const auto vector = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
    truth.push_back({rotation_exp(vector()), 5.0 * vector()});
    graph.vertices.push_back({id, id == 0 ? truth[0] : Rigid3{}});
  }
  const auto join = [&](std::size_t a, std::size_t b) {
    graph.edges.push_back({static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
                           truth[a].inverse() * truth[b], information_from_std(0.1, 0.1), false});
  };
  for (std::size_t i = 0; i < 20; ++i) join(i, (i + 1) % 20);
  join(15, 4);
  return graph;
}

TEST(ChordalRelaxation, RecoversExactPosesFromTheMeasurementsAlone) {
  std::vector<Rigid3> truth;
  const PoseGraph graph = exact_ring(truth);
  const std::vector<Rigid3> relaxed = relax_chordal(graph, analyse_pose_graph(graph));
  ASSERT_EQ(relaxed.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT(motion_norm(truth[i].inverse() * relaxed[i]), 1e-9) << i;
  }
}

TEST(ChordalRelaxation, LeavesHeldVerticesAlone) {
  std::vector<Rigid3> truth;
  PoseGraph graph = exact_ring(truth);
  graph.fixed = {3, 11};
  graph.vertices[3].world_from_vertex = {rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  const std::vector<Rigid3> relaxed = relax_chordal(graph, analyse_pose_graph(graph));
  ASSERT_EQ(relaxed.size(), truth.size());
  EXPECT_EQ(relaxed[3].translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(relaxed[11].translation, Eigen::Vector3d::Zero());
}

TEST(ChordalRelaxation, SaysWhenTheInformationDoesNotDetermineAPose) {
  PoseGraph graph;
  graph.vertices = {{0, {}}, {1, {}}};
  graph.edges = {{0, 1, {}, Matrix6d::Zero(), false}};
  EXPECT_TRUE(relax_chordal(graph, analyse_pose_graph(graph)).empty());
}

}  // namespace
}  // namespace cairn
