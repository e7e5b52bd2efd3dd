// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/keyframe_covariances.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "cairn/core/random.h"
#include "cairn/optimize/pose_graph_residual.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

/// Five keyframes in a row, half a metre apart, along a wall of points.
testkit::MapMaker along_a_wall() {
  testkit::PointWorld world;
  Random random(4);
  for (int i = 0; i < 600; ++i)
    world.add({random.uniform(-2, 5), random.uniform(-1, 1), random.uniform(2, 3)});
  testkit::MapMaker maker(world);
  for (int k = 0; k < 5; ++k) (void)maker.add(testkit::aside(0.5 * k));
  return maker;
}

std::vector<KeyframeCovariance> covariances_of(const Map& map) {
  Window whole = whole_component(map, 0);
  const BundleReport report = adjust_bundle(whole.problem, {});
  std::vector<KeyframeCovariance> covariances;
  keep_keyframe_covariances(map, whole, report.inlier, SharedField::none, Executor(), covariances);
  return covariances;
}

TEST(KeyframeCovariances, are_from_the_first_and_the_one_before) {
  testkit::MapMaker maker = along_a_wall();
  const auto covariances = covariances_of(maker.map);
  ASSERT_EQ(covariances.size(), 5U);
  EXPECT_EQ(covariances[0].from_first, Matrix6d(Matrix6d::Zero()));
  EXPECT_FALSE(covariances[0].from_previous);
  EXPECT_EQ(covariances[1].from_first, covariances[1].from_previous);
  for (std::size_t k = 1; k < 5; ++k) {
    ASSERT_TRUE(covariances[k].from_first && covariances[k].from_previous) << k;
    EXPECT_EQ(covariances[k].from_first->llt().info(), Eigen::Success) << k;
  }
}

TEST(KeyframeCovariances, those_of_a_start_map_are_passed_over) {
  testkit::MapMaker maker = along_a_wall();
  maker.map.end_recording();
  (void)maker.add(testkit::aside(1.1));
  (void)maker.add(testkit::aside(1.6));
  const auto covariances = covariances_of(maker.map);
  ASSERT_EQ(covariances.size(), 7U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_FALSE(covariances[k].from_first) << k;
  EXPECT_EQ(covariances[5].from_first, Matrix6d(Matrix6d::Zero()));
  EXPECT_TRUE(covariances[6].from_previous);
}

TEST(KeyframeCovariances, the_information_of_an_edge_weighs_its_error_alike) {
  Matrix6d root;
  Random random(1);
  for (double& value : root.reshaped()) value = random.uniform(-1, 1);
  const Matrix6d covariance = 1e-8 * (root * root.transpose() + Matrix6d::Identity());
  const Rigid3 a{rotation_exp({0.2, 0.4, -0.3}), {1, 2, 3}}, b{rotation_exp({-0.2, 0.1, 0.5}), {2, 2, 4}};
  Vector6d xi;
  xi << 1e-5, -2e-5, 3e-5, 2e-5, -1e-5, 1e-5;
  const Rigid3 estimated_b_from_a = b.inverse() * a;
  const Rigid3 true_b = a * perturb_left(xi, estimated_b_from_a).inverse();
  const Vector6d error = pose_graph_error(a, true_b, estimated_b_from_a.inverse());
  const auto information = edge_information_of(covariance);
  ASSERT_TRUE(information);
  const double expected = xi.dot(covariance.llt().solve(xi));
  EXPECT_NEAR(error.dot(*information * error), expected, 1e-3 * expected);
  EXPECT_FALSE(edge_information_of(Matrix6d::Zero()));
}

}  // namespace
}  // namespace cairn
