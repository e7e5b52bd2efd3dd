// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/alignment_ransac.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr double kSigma = 0.01;
constexpr double kSize = 3;

struct PointSets {
  Similarity3 target_from_source;
  std::vector<Eigen::Vector3d> source, target;
};

Eigen::Vector3d random_point(Random& random) {
  return {random.uniform(-kSize, kSize), random.uniform(-kSize, kSize), random.uniform(-kSize, kSize)};
}

PointSets make_sets(std::uint64_t seed, int count, int outliers, double scale = 1.0) {
  Random random(seed);
  PointSets sets;
  sets.target_from_source = {scale, rotation_exp(random_point(random)), random_point(random)};
  for (int i = 0; i < count; ++i) {
    sets.source.push_back(random_point(random));
    sets.target.push_back(
        i < outliers
            ? random_point(random)
            : Eigen::Vector3d(sets.target_from_source * sets.source.back() +
                              kSigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal())));
  }
  return sets;
}

TEST(AlignmentRansac, finds_the_transform_among_outliers) {
  for (const int outliers : {0, 50, 70}) {
    for (const double scale : {1.0, 1.7}) {
      const PointSets sets = make_sets(1, 100, outliers, scale);
      const auto result = align_points_ransac(sets.source, sets.target, scale != 1.0, kSigma, {});
      ASSERT_TRUE(result.found());
      const Similarity3& found = result.model;
      EXPECT_LT(rotation_angle(found.rotation.conjugate() * sets.target_from_source.rotation), 0.005);
      EXPECT_LT((found.translation - sets.target_from_source.translation).norm(), 0.01);
      EXPECT_NEAR(found.scale, scale, scale == 1.0 ? 0 : 0.005);
      EXPECT_GE(result.inliers.front(), outliers);
      EXPECT_GT(static_cast<int>(result.inliers.size()), (100 - outliers) * 85 / 100);
    }
  }
}

TEST(AlignmentRansac, says_why_there_is_none) {
  PointSets sets = make_sets(2, 50, 50);
  EXPECT_EQ(align_points_ransac(sets.source, sets.target, false, kSigma, {}).status, RansacStatus::by_chance);
  EXPECT_EQ(align_points_ransac({}, {}, false, kSigma, {}).status, RansacStatus::too_few_data);
  for (std::size_t i = 0; i < 50; ++i) sets.source[i] = sets.target[i] = {0.1 * static_cast<double>(i), 0, 0};
  EXPECT_EQ(align_points_ransac(sets.source, sets.target, false, kSigma, {}).status,
            RansacStatus::degenerate);
  sets.source[0].x() = std::nan("");
  EXPECT_THROW((void)align_points_ransac(sets.source, sets.target, false, kSigma, {}), PreconditionError);
}

}  // namespace
}  // namespace cairn
