// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/testing/geometry/two_view_scene.h"

namespace cairn {
namespace {

using testkit::make_two_view_scene;
using testkit::TwoViewScene;

TEST(Triangulation, finds_the_point_without_noise) {
  const TwoViewScene scene = make_two_view_scene(1, 200);
  int count = 0;
  for (std::size_t i = 0; i < scene.a.size(); ++i) {
    const auto found = triangulate(scene.b_from_a, scene.a[i], scene.b[i], 1e-3);
    if (!found) continue;
    ++count;
    EXPECT_LT((found->point_in_a - scene.points_in_a[i]).norm(), 1e-8);
    EXPECT_LT(found->squared_error, 1e-20);
    const Eigen::Vector3d to_b = scene.points_in_a[i] - scene.b_from_a.inverse().translation;
    EXPECT_NEAR(std::cos(found->angle), scene.points_in_a[i].normalized().dot(to_b.normalized()), 1e-12);
  }
  EXPECT_GE(count, 190);
}

TEST(Triangulation, is_a_minimum_of_the_squared_error) {
  const TwoViewScene scene = make_two_view_scene(2, 100, 0, 0.002);
  int compared = 0;
  for (std::size_t i = 0; i < scene.a.size(); ++i) {
    const auto found = triangulate(scene.b_from_a, scene.a[i], scene.b[i], 0.03);
    if (!found) continue;
    const auto cost = [&](const Eigen::Vector3d& point) {
      return (point.hnormalized() - scene.a[i]).squaredNorm() +
             ((scene.b_from_a * point).hnormalized() - scene.b[i]).squaredNorm();
    };
    EXPECT_NEAR(found->squared_error, cost(found->point_in_a), 1e-15);
    for (int axis = 0; axis < 3; ++axis)
      for (const double move : {-1e-3, 1e-3})
        EXPECT_LT(found->squared_error, cost(found->point_in_a + move * Eigen::Vector3d::Unit(axis)));
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

TEST(Triangulation, has_no_point_behind_a_camera_or_far_away) {
  const Rigid3 b_from_a{Eigen::Quaterniond::Identity(), {-1, 0, 0}};
  EXPECT_TRUE(triangulate(b_from_a, {0.1, 0}, {-0.1, 0}, 0.01));
  EXPECT_FALSE(triangulate(b_from_a, {-0.1, 0}, {0.1, 0}, 0.01));
  EXPECT_FALSE(triangulate(b_from_a, {0.1, 0}, {0.095, 0}, 0.01));
  EXPECT_FALSE(triangulate(b_from_a, {0.1, 0}, {0.1, 0}, 0));
}

}  // namespace
}  // namespace cairn
