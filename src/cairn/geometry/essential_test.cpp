// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/essential.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/essential_ransac.h"
#include "cairn/testing/geometry/two_view_scene.h"

namespace cairn {
namespace {

using testkit::make_two_view_scene;
using testkit::TwoViewScene;

constexpr double kSigma = 1.0 / 500;  // one pixel of a camera with 500 pixels of focal length

/// Angles of rotation and direction between the truth and the nearest candidate of E, radians.
Eigen::Vector2d error_of(const Eigen::Matrix3d& E, const Rigid3& truth) {
  Eigen::Vector2d best(10, 10);
  for (const Rigid3& candidate : decompose_essential(E).candidates()) {
    const double turn = rotation_angle(candidate.rotation.conjugate() * truth.rotation);
    const double direction = (candidate.translation.normalized() - truth.translation.normalized()).norm();
    if (turn + direction < best.sum()) best = {turn, direction};
  }
  return best;
}

TEST(Essential, is_taken_apart_and_put_together) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 1);
    const Eigen::Matrix3d E = essential_of(scene.b_from_a);
    const EssentialDecomposition parts = decompose_essential(E);
    EXPECT_LT((skew(parts.translation) * parts.rotations[0] - E).norm(), 1e-14);
    EXPECT_LT((skew(-parts.translation) * parts.rotations[1] - E).norm(), 1e-14);
    for (const auto& R : parts.rotations) EXPECT_NEAR(R.determinant(), 1, 1e-14);
    EXPECT_NEAR(parts.translation.norm(), scene.b_from_a.translation.norm(), 1e-14);
    EXPECT_LT(error_of(E, scene.b_from_a).sum(), 1e-7);
  }
}

/// An example whose usual printed solution are the factors U W^T V^T and U W V^T of
/// determinant -1: the rotations are their negatives, and E = skew(t) second = skew(-t) (-second).
TEST(Essential, decomposes_the_known_example) {
  Eigen::Matrix3d E, first, second;
  E << -0.0203618550523477, -0.4007110038118445, -0.03324074249824097, 0.3939270778216369,
      -0.03506401846698079, 0.5857110303721015, -0.006788487241438284, -0.5815434272915686,
      -0.01438258684486258;
  first << -0.365887, -0.0584576, 0.928822, -0.00287462, 0.998092, 0.0616848, 0.930655, -0.0198996, 0.365356;
  second << -0.998596, 0.0516992, -0.0115267, -0.0513961, -0.99836, -0.0252005, 0.0128107, 0.0245727,
      -0.999616;
  const Eigen::Vector3d t(0.581301, 0.0231206, -0.401938);
  const EssentialDecomposition parts = decompose_essential(E);
  EXPECT_LT((parts.singular_values - Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0)).norm(), 1e-6);
  EXPECT_LT((parts.factors[0] - first).norm(), 5e-6);
  EXPECT_LT((parts.factors[1] - second).norm(), 5e-6);
  EXPECT_LT((parts.rotations[0] + first).norm(), 5e-6);
  EXPECT_LT((parts.rotations[1] + second).norm(), 5e-6);
  EXPECT_LT(std::min((parts.translation - t).norm(), (parts.translation + t).norm()), 1e-6);
  EXPECT_LT((skew(parts.translation) * parts.rotations[0] - E).norm(), 1e-12);
}

TEST(Essential, sampson_error_is_the_squared_distance_to_first_order) {
  const TwoViewScene exact = make_two_view_scene(3, 100), noisy = make_two_view_scene(3, 100, 0, 1e-4);
  const Eigen::Matrix3d E = essential_of(exact.b_from_a);
  double sum = 0;
  for (std::size_t i = 0; i < exact.a.size(); ++i) {
    EXPECT_NEAR(sampson_error(E, exact.a[i], exact.b[i]), 0, 1e-24);
    sum += sampson_error(E, noisy.a[i], noisy.b[i]);
  }
  EXPECT_NEAR(sum / 100 / 1e-8, 1.0, 0.4);  // chi-square with one degree of freedom has mean 1
}

TEST(Essential, refinement_reaches_the_truth_without_noise) {
  const TwoViewScene scene = make_two_view_scene(4, 30);
  std::vector<std::int32_t> all(30);
  for (std::size_t i = 0; i < 30; ++i) all[i] = static_cast<std::int32_t>(i);
  Vector6d xi;
  xi << 0.02, -0.01, 0.02, 0.03, 0.02, -0.03;
  Rigid3 b_from_a = perturb_left(xi, scene.b_from_a);
  ASSERT_TRUE(refine_essential(scene.a, scene.b, all, 10, b_from_a));
  EXPECT_LT(rotation_angle(b_from_a.rotation.conjugate() * scene.b_from_a.rotation), 1e-7);
  EXPECT_LT((b_from_a.translation - scene.b_from_a.translation.normalized()).norm(), 1e-8);
  EXPECT_NEAR(b_from_a.translation.norm(), 1, 1e-14);
}

TEST(EssentialRansac, finds_the_motion_among_outliers) {
  for (const int outliers : {0, 100, 150}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const TwoViewScene scene = make_two_view_scene(seed, 300, outliers, kSigma / 4, 1.0);
      const auto result =
          find_essential(scene.a, scene.b, kSigma / 4, {.max_iterations = 2000, .item = seed});
      ASSERT_TRUE(result.found());
      const Eigen::Vector2d error = error_of(result.model, scene.b_from_a);
      EXPECT_LT(error.x(), 0.01) << outliers << " " << seed;
      EXPECT_LT(error.y(), 0.05) << outliers << " " << seed;
    }
  }
}

TEST(EssentialRansac, repeats_itself_from_seed_and_item) {
  const TwoViewScene scene = make_two_view_scene(5, 100, 50, kSigma);
  const auto find = [&](std::uint64_t seed, std::uint64_t item) {
    return find_essential(scene.a, scene.b, kSigma, {.seed = seed, .item = item});
  };
  EXPECT_EQ(find(1, 2).model, find(1, 2).model);
  EXPECT_EQ(find(1, 2).inliers, find(1, 2).inliers);
  EXPECT_NE(find(1, 2).model, find(1, 3).model);
}

TEST(EssentialRansac, says_so_where_nothing_fits) {
  for (const int count : {5, 6, 10, 30, 100, 500}) {
    const TwoViewScene scene = make_two_view_scene(static_cast<std::uint64_t>(count), count, count);
    EXPECT_EQ(find_essential(scene.a, scene.b, kSigma, {}).status, RansacStatus::by_chance) << count;
  }
}

TEST(EssentialRansac, says_so_where_there_is_too_little) {
  const TwoViewScene few = make_two_view_scene(6, 4);
  EXPECT_EQ(find_essential(few.a, few.b, kSigma, {}).status, RansacStatus::too_few_data);
  TwoViewScene line = make_two_view_scene(7, 50);
  for (std::size_t i = 0; i < line.a.size(); ++i) line.a[i].y() = line.b[i].y() = 0;
  EXPECT_FALSE(find_essential(line.a, line.b, kSigma, {}).found());
  TwoViewScene turned = make_two_view_scene(8, 50, 0, 0, 0.0);
  EXPECT_FALSE(find_essential(turned.a, turned.b, kSigma, {}).found());
}

TEST(EssentialRansac, refuses_numbers_that_are_not_finite) {
  TwoViewScene scene = make_two_view_scene(9, 10);
  scene.b[3].x() = std::nan("");
  EXPECT_THROW((void)find_essential(scene.a, scene.b, kSigma, {}), PreconditionError);
  scene.b.pop_back();
  EXPECT_THROW((void)find_essential(scene.a, scene.b, kSigma, {}), PreconditionError);
}

}  // namespace
}  // namespace cairn
