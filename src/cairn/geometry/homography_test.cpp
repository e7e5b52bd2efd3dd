// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/homography.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "cairn/testing/geometry/two_view_scene.h"

namespace cairn {
namespace {

using testkit::make_two_view_scene;
using testkit::SceneShape;
using testkit::TwoViewScene;

constexpr double kSigma = 1.0 / 500;

/// Of the plane of make_two_view_scene, z (1 + 0.5 x - 0.3 y) = 3 in (x/z, y/z), with Frobenius norm 1.
Eigen::Matrix3d true_homography(const TwoViewScene& scene) {
  const Eigen::Vector3d normal_over_distance = Eigen::Vector3d(0.5, -0.3, 1) / 3;
  const Eigen::Matrix3d H =
      scene.b_from_a.matrix3() + scene.b_from_a.translation * normal_over_distance.transpose();
  return H / H.norm();
}

TEST(Homography, fit_is_exact_without_noise) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 10, 0, 0, 0.5, SceneShape::plane);
    const auto H = fit_homography(scene.a, scene.b, std::vector<std::int32_t>{0, 2, 3, 5, 7, 8});
    ASSERT_TRUE(H);
    EXPECT_LT((*H - true_homography(scene)).norm(), 1e-9);
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_LT(homography_sampson_error(*H, scene.a[i], scene.b[i]), 1e-18);
  }
}

TEST(Homography, sampson_error_is_the_squared_distance_to_first_order) {
  const TwoViewScene noisy = make_two_view_scene(3, 200, 0, 1e-4, 0.5, SceneShape::plane);
  double sum = 0;
  for (std::size_t i = 0; i < 200; ++i)
    sum += homography_sampson_error(true_homography(noisy), noisy.a[i], noisy.b[i]);
  EXPECT_NEAR(sum / 200 / 1e-8, 2.0, 0.4);  // chi-square with two degrees of freedom has mean 2
}

TEST(Homography, weighting_lowers_the_sampson_error) {
  const TwoViewScene scene = make_two_view_scene(4, 60, 0, 0.01, 1.5, SceneShape::plane);
  std::vector<std::int32_t> all(60);
  for (std::size_t i = 0; i < 60; ++i) all[i] = static_cast<std::int32_t>(i);
  const auto cost = [&](const Eigen::Matrix3d& H) {
    double sum = 0;
    for (std::size_t i = 0; i < 60; ++i) sum += homography_sampson_error(H, scene.a[i], scene.b[i]);
    return sum;
  };
  const Eigen::Matrix3d linear = fit_homography(scene.a, scene.b, all).value();
  const Eigen::Matrix3d weighted = fit_homography(scene.a, scene.b, all, &linear).value();
  EXPECT_LT(cost(weighted), cost(linear));
}

TEST(Homography, decomposition_holds_the_true_motion) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 1);
    double best = 1;
    for (const Rigid3& motion : decompose_homography(true_homography(scene))) {
      EXPECT_NEAR(motion.rotation.norm(), 1, 1e-12);
      const double turn = rotation_angle(motion.rotation.conjugate() * scene.b_from_a.rotation);
      const double move = (motion.translation.normalized() - scene.b_from_a.translation.normalized()).norm();
      best = std::min(best, turn + move);
    }
    EXPECT_LT(best, 1e-6) << seed;
  }
}

TEST(HomographyRansac, finds_the_plane_among_outliers) {
  for (const int outliers : {0, 100, 150}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const TwoViewScene scene = make_two_view_scene(seed, 300, outliers, kSigma / 2, 1.0, SceneShape::plane);
      const auto result = find_homography(scene.a, scene.b, kSigma / 2, {});
      ASSERT_TRUE(result.found());
      EXPECT_LT((result.model - true_homography(scene)).norm(), 0.003) << outliers << " " << seed;
      EXPECT_GT(static_cast<int>(result.inliers.size()), (300 - outliers) * 9 / 10);
    }
  }
}

TEST(HomographyRansac, says_why_there_is_none) {
  const TwoViewScene few = make_two_view_scene(6, 3);
  EXPECT_EQ(find_homography(few.a, few.b, kSigma, {}).status, RansacStatus::too_few_data);
  TwoViewScene line = make_two_view_scene(7, 50);
  for (std::size_t i = 0; i < line.a.size(); ++i) line.a[i].y() = line.b[i].y() = 0;
  EXPECT_EQ(find_homography(line.a, line.b, kSigma, {}).status, RansacStatus::degenerate);
  EXPECT_FALSE(fit_homography(line.a, line.b, std::vector<std::int32_t>{0, 1, 2, 3, 4}));
  const TwoViewScene wrong = make_two_view_scene(8, 100, 100);
  EXPECT_EQ(find_homography(wrong.a, wrong.b, kSigma, {}).status, RansacStatus::by_chance);
}

}  // namespace
}  // namespace cairn
