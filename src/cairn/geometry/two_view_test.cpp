// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/two_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/testing/geometry/two_view_scene.h"

namespace cairn {
namespace {

using testkit::make_two_view_scene;
using testkit::SceneShape;
using testkit::TwoViewScene;

constexpr double kSigma = 1.0 / 500;  // a pixel

TwoViewResult reconstruct(const TwoViewScene& scene, double sigma = kSigma / 2) {
  return reconstruct_two_views(scene.a, scene.b, sigma);
}

TEST(TwoView, finds_motion_and_points_among_outliers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 300, 100, kSigma / 2, 1.0);
    const TwoViewResult result = reconstruct(scene);
    ASSERT_EQ(result.status, TwoViewStatus::ok) << seed;
    EXPECT_EQ(result.choice.model, TwoViewModel::essential);
    EXPECT_LT(rotation_angle(result.b_from_a.rotation.conjugate() * scene.b_from_a.rotation), 0.02) << seed;
    EXPECT_LT((result.b_from_a.translation - scene.b_from_a.translation).norm(), 0.1) << seed;
    double relative_error = 0;
    for (const TwoViewPoint& point : result.points) {
      const double truth = scene.points_in_a[static_cast<std::size_t>(point.pair)].z();
      relative_error += std::abs(point.triangulated.point_in_a.z() / truth - 1);
    }
    EXPECT_GT(result.points.size(), 150U);
    EXPECT_LT(relative_error / static_cast<double>(result.points.size()), 0.1) << seed;
  }
}

/// The plane's two motions can both have all points in front; where one is said to be right it is.
TEST(TwoView, takes_a_plane_for_a_plane) {
  int right = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 300, 60, kSigma / 2, 1.5, SceneShape::plane);
    const TwoViewResult result = reconstruct(scene);
    EXPECT_EQ(result.choice.model, TwoViewModel::homography) << seed;
    ASSERT_TRUE(result.status == TwoViewStatus::ok || result.status == TwoViewStatus::ambiguous_motion);
    if (result.status != TwoViewStatus::ok) continue;
    ++right;
    EXPECT_LT((result.b_from_a.translation - scene.b_from_a.translation.normalized()).norm(), 0.1) << seed;
  }
  EXPECT_GT(right, 0);
}

TEST(TwoView, takes_a_turn_for_a_turn) {
  for (const double sigma : {0.0, kSigma / 2}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const TwoViewScene scene = make_two_view_scene(seed, 200, 50, sigma, 0.0);
      const TwoViewResult result = reconstruct(scene);
      EXPECT_EQ(result.status, TwoViewStatus::no_translation) << seed;
      EXPECT_EQ(result.choice.model, TwoViewModel::rotation) << seed;
      EXPECT_LT(rotation_angle(result.b_from_a.rotation.conjugate() * scene.b_from_a.rotation), 0.01);
      EXPECT_TRUE(result.points.empty());
    }
  }
}

TEST(TwoView, says_why_there_is_no_motion) {
  EXPECT_EQ(reconstruct(make_two_view_scene(1, 4)).status, TwoViewStatus::too_few_points);
  EXPECT_EQ(reconstruct(make_two_view_scene(2, 100, 100)).status, TwoViewStatus::no_model);
  TwoViewScene line = make_two_view_scene(3, 50);
  for (std::size_t i = 0; i < line.a.size(); ++i) line.a[i].y() = line.b[i].y() = 0;
  EXPECT_EQ(reconstruct(line).status, TwoViewStatus::no_model);
}

TEST(TwoView, depth_gives_the_scale) {
  const TwoViewScene scene = make_two_view_scene(4, 200, 0, kSigma / 10, 0.8);
  const TwoViewResult result = reconstruct(scene, kSigma / 10);
  ASSERT_EQ(result.status, TwoViewStatus::ok);
  std::vector<double> depths;
  for (const TwoViewPoint& point : result.points)
    depths.push_back(point.pair % 3 == 0 ? 0.0 : scene.points_in_a[static_cast<std::size_t>(point.pair)].z());
  const MetricScale scale = metric_scale(result.points, depths);
  EXPECT_NEAR(scale.metres_per_unit, 0.8, 0.02);
  EXPECT_LT(scale.relative_mad, 0.05);
  EXPECT_LT(scale.points, result.points.size());
  EXPECT_EQ(metric_scale({}, {}).points, 0U);
}

TEST(TwoView, choice_needs_a_model) {
  const TwoViewScene scene = make_two_view_scene(5, 20);
  const ModelChoice none = choose_model(scene.a, scene.b, kSigma, nullptr, nullptr);
  for (const double gric : none.gric) EXPECT_TRUE(std::isinf(gric));
}

}  // namespace
}  // namespace cairn
