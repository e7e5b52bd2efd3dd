// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

Rigid3 random_pose(Random& random, double reach_m, double angle_rad) {
  const auto vector = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  return {rotation_exp(angle_rad * vector()), reach_m * vector()};
}

TEST(PoseGraphResidual, IsZeroWhereTheMeasurementHolds) {
  Random random(1);
  const Rigid3 world_from_a = random_pose(random, 10, 1), a_from_b = random_pose(random, 1, 1);
  EXPECT_LT(pose_graph_error(world_from_a, world_from_a * a_from_b, a_from_b).norm(), 1e-14);
}

TEST(PoseGraphResidual, IsTheDisplacementInTheFrameOfTheMeasuredB) {
  const Rigid3 a_from_b{rotation_exp({0, 0, 1.5}), {4, 5, 6}};
  const Rigid3 b_from_displaced{rotation_exp({0.2, 0, 0}), {0.1, 0.2, 0.3}};
  const Rigid3 world_from_a{rotation_exp({1, 2, 3}), {7, 8, 9}};
  const Vector6d error = pose_graph_error(world_from_a, world_from_a * a_from_b * b_from_displaced, a_from_b);
  Vector6d expected;
  expected << 0.1, 0.2, 0.3, std::sin(0.1), 0, 0;
  EXPECT_LT((error - expected).norm(), 1e-14);
}

TEST(PoseGraphResidual, TakesTheShorterWayAround) {
  const Rigid3 plain, turned{Eigen::Quaterniond(-std::cos(0.1), std::sin(0.1), 0, 0), {0, 0, 0}};
  EXPECT_NEAR(pose_graph_error(plain, turned, plain)(3), -std::sin(0.1), 1e-15);
}

/// Central differences over perturb_vertex; `move_b` chooses the vertex.
Matrix6d numeric_jacobian(const Rigid3& a, const Rigid3& b, const Rigid3& a_from_b, bool move_b) {
  constexpr double kStep = 1e-6;
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vector6d xi = kStep * Vector6d::Unit(i);
    const auto error = [&](const Vector6d& step) {
      return move_b ? pose_graph_error(a, perturb_vertex(step, b), a_from_b)
                    : pose_graph_error(perturb_vertex(step, a), b, a_from_b);
    };
    jacobian.col(i) = (error(xi) - error(-xi)) / (2 * kStep);
  }
  return jacobian;
}

TEST(PoseGraphResidual, JacobiansEqualFiniteDifferences) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Rigid3 a = random_pose(random, 10, 2), a_from_b = random_pose(random, 3, 2);
    const Rigid3 b = a * a_from_b * random_pose(random, 0.5, 0.7);
    const PoseGraphJacobians jacobians = pose_graph_jacobians(a, b, a_from_b);
    EXPECT_LT((jacobians.by_a - numeric_jacobian(a, b, a_from_b, false)).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((jacobians.by_b - numeric_jacobian(a, b, a_from_b, true)).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(PoseGraphResidual, JacobiansDoNotDependOnTheOrigin) {
  Random random(3);
  const Rigid3 a = random_pose(random, 1, 1), b = random_pose(random, 1, 1), a_from_b;
  const Eigen::Vector3d far(4.5e6, 5.2e6, 300);
  const PoseGraphJacobians near_origin = pose_graph_jacobians(a, b, a_from_b);
  const PoseGraphJacobians far_away =
      pose_graph_jacobians({a.rotation, a.translation + far}, {b.rotation, b.translation + far}, a_from_b);
  EXPECT_LT((near_origin.by_a - far_away.by_a).norm(), 1e-8);
}

TEST(PoseGraphResidual, Chi2WeighsWithTheInformation) {
  PoseGraph graph;
  graph.vertices = {{0, {}}, {1, {Eigen::Quaterniond::Identity(), {1, 2, 0}}}};
  Matrix6d information = Matrix6d::Identity();
  information(0, 1) = information(1, 0) = 0.5;
  graph.edges = {{0, 1, {}, information, true}, {1, 0, {}, 2 * Matrix6d::Identity(), false}};
  EXPECT_EQ(edge_chi2(graph), (std::vector<double>{1 + 4 + 2 * 0.5 * 2, 10}));
  EXPECT_EQ(chi2(graph), 17);
  graph.edges[0].b = 5;
  EXPECT_THROW((void)chi2(graph), PreconditionError);
}

}  // namespace
}  // namespace cairn
