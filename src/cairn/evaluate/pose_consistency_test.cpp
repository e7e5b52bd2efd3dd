// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_consistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "cairn/core/random.h"

namespace cairn {
namespace {

Vector6d random_six(Random& random) {
  Vector6d values;
  for (double& value : values) value = random.normal();
  return values;
}

Matrix6d random_covariance(Random& random) {
  Matrix6d root;
  for (double& value : root.reshaped()) value = random.normal();
  Vector6d sigmas;
  sigmas << 1e-3, 2e-3, 1e-3, 0.02, 0.01, 0.05;
  return sigmas.asDiagonal() * (root * root.transpose() + Matrix6d::Identity()) * sigmas.asDiagonal();
}

Rigid3 true_camera_from_world(int i) {
  return {rotation_exp({0.01 * i, 0.02 * i, -0.005 * i}), {0.3 * i, 1, 100.0 + i}};
}

/// Poses whose errors have `stretch` times the covariance that the table states.
struct Scene {
  CovarianceTable table;
  std::vector<PosePair> pairs;
};

Scene localizations(double stretch, int count = 3000) {
  Random random(21);
  Scene scene;
  scene.table.prefixes = {"cov_"};
  for (int i = 0; i < count; ++i) {
    const Matrix6d covariance = random_covariance(random);
    const Vector6d error =
        std::sqrt(stretch) * (Eigen::MatrixXd(covariance.llt().matrixL()) * random_six(random));
    const Rigid3 truth = true_camera_from_world(i % 50);
    scene.table.rows.push_back({1'000 * i, i + 2, i % 10 == 9, {covariance}});
    // the truth is the estimate with the error taken off
    scene.pairs.push_back({1'000 * i, perturb_left(error, truth).inverse(), truth.inverse()});
  }
  return scene;
}

TEST(PoseConsistency, FindsHonestPosesHonest) {
  const Scene scene = localizations(1);
  const auto stated = assess_localizations(scene.table, scene.pairs, 1);
  ASSERT_EQ(stated.size(), 2U);
  EXPECT_EQ(stated[0].scope, CovarianceScope::in_map);
  EXPECT_FALSE(stated[0].is_weak);
  EXPECT_TRUE(stated[1].is_weak);
  const PoseConsistency& good = *stated[0].consistency;
  EXPECT_EQ(good.pose.report.count, 2700U);
  EXPECT_EQ(stated[1].consistency->pose.report.count, 300U);
  EXPECT_EQ(good.pose.report.degrees_of_freedom, 6);
  for (const ErrorConsistency* part : {&good.pose, &good.position, &good.rotation}) {
    EXPECT_NEAR(part->report.mean_per_freedom(), 1, 0.05);
    for (const Coverage& coverage : part->report.coverage)
      EXPECT_LT(std::abs(coverage.actual - coverage.nominal), 3.5 * coverage.standard_error);
  }
  EXPECT_EQ(good.position.report.degrees_of_freedom, 3);
  EXPECT_GT(good.position.std_per_error(), 1.1);
  EXPECT_LT(good.position.std_per_error(), 1.5);
}

/// Only the rotation is wrong: its own figures say so, those of the position do not.
TEST(PoseConsistency, TellsPositionAndRotationApart) {
  Scene scene = localizations(1);
  for (CovarianceRow& row : scene.table.rows) {
    row.covariances[0]->topRows<3>() *= 0.5;
    row.covariances[0]->leftCols<3>() *= 0.5;
  }
  const auto stated = assess_localizations(scene.table, scene.pairs, 1);
  EXPECT_NEAR(stated[0].consistency->position.report.mean_per_freedom(), 1, 0.05);
  EXPECT_NEAR(stated[0].consistency->rotation.report.mean_per_freedom(), 4, 0.2);
  EXPECT_EQ(stated[0].consistency->rotation.report.verdict, CovarianceVerdict::overconfident);
}

/// Another world changes nothing, as the error is in the camera's axes; another scale is taken into account.
TEST(PoseConsistency, DoesNotDependOnTheWorld) {
  const Scene scene = localizations(1, 100);
  const double expected =
      assess_localizations(scene.table, scene.pairs, 1)[0].consistency->pose.report.mean_nees;
  const Similarity3 turned{2, rotation_exp({1, -2, 0.5}), {10, 20, -30}};
  std::vector<PosePair> moved = scene.pairs;
  for (PosePair& pair : moved) {
    pair.estimate = turned * pair.estimate;
    pair.reference = turned * pair.reference;
  }
  EXPECT_NEAR(assess_localizations(scene.table, moved, 2)[0].consistency->pose.report.mean_nees, expected,
              1e-6 * expected);
}

TEST(PoseConsistency, CountsWhatCannotBeJudged) {
  Scene scene = localizations(1, 20);
  scene.table.rows[3].covariances[0].reset();
  scene.pairs.erase(scene.pairs.begin() + 5);
  scene.pairs.erase(scene.pairs.begin() + 5);
  const auto stated = assess_localizations(scene.table, scene.pairs, 1);
  EXPECT_EQ(stated[0].without_covariance, 1U);
  EXPECT_EQ(stated[0].without_truth, 2U);
  EXPECT_EQ(stated[0].consistency->pose.report.count, 15U);
  EXPECT_FALSE(assess_localizations(scene.table, {}, 1)[0].consistency);
}

/// Keyframes of two components, each motion with an error of its own.
Scene keyframes(double stretch_of_first, double stretch_of_previous) {
  Random random(22);
  constexpr int kEach = 400, kCount = 2 * kEach;
  Scene scene;
  scene.table.prefixes = {"first_cov_", "previous_cov_"};
  Rigid3 first, previous;
  for (int i = 0; i < kCount; ++i) {
    const Matrix6d step = random_covariance(random);
    const Vector6d error = Eigen::MatrixXd(step.llt().matrixL()) * random_six(random);
    const Rigid3 truth = true_camera_from_world(i % 50);
    CovarianceRow row{1'000 * i, i + 2, false, {std::nullopt, std::nullopt}};
    Rigid3 estimate{rotation_exp({0.5, 0.2, 0}), {5, 6, 7}};  // of another world in each component
    if (i % kEach != 0) {
      // the error is one of the motion from the first keyframe in odd rows, from the one before in even rows
      const bool of_first = i % 2 != 0;
      const std::size_t from =
          of_first ? static_cast<std::size_t>(i / kEach * kEach) : static_cast<std::size_t>(i) - 1;
      const Rigid3 motion = truth * scene.pairs[from].reference;
      estimate = perturb_left(error, motion) * scene.pairs[from].estimate.inverse();
      row.covariances[of_first ? 0 : 1] = step / (of_first ? stretch_of_first : stretch_of_previous);
      if (of_first) row.covariances[1] = 1e6 * Matrix6d::Identity();
    }
    scene.table.rows.push_back(row);
    scene.pairs.push_back({1'000 * i, estimate.inverse(), truth.inverse()});
  }
  return scene;
}

TEST(PoseConsistency, ComparesMotionsOfKeyframes) {
  const Scene scene = keyframes(1, 4);
  const auto stated = assess_keyframes(scene.table, scene.pairs, 1);
  ASSERT_EQ(stated.size(), 2U);
  EXPECT_EQ(stated[0].scope, CovarianceScope::from_first);
  EXPECT_EQ(stated[1].scope, CovarianceScope::from_previous);
  EXPECT_EQ(stated[0].consistency->pose.report.count, 400U);
  EXPECT_EQ(stated[0].without_covariance, 398U);
  EXPECT_NEAR(stated[0].consistency->pose.report.mean_per_freedom(), 1, 0.1);
  EXPECT_EQ(stated[1].consistency->pose.report.count, 798U);
  // 398 of 798 have four times the variance that is stated, 400 next to none of it
  EXPECT_NEAR(stated[1].consistency->pose.report.mean_per_freedom(), 4 * 398.0 / 798, 0.2);
}

TEST(PoseConsistency, SkipsMotionsOfAKeyframeWithoutTruth) {
  Scene scene = keyframes(1, 1);
  scene.pairs.erase(scene.pairs.begin() + 10);
  const auto stated = assess_keyframes(scene.table, scene.pairs, 1);
  EXPECT_EQ(stated[0].without_truth, 1U);
  EXPECT_EQ(stated[1].without_truth, 2U);
  scene.pairs.erase(scene.pairs.begin());  // the first keyframe: nothing is known relative to it
  EXPECT_EQ(assess_keyframes(scene.table, scene.pairs, 1)[0].without_truth, 399U);
}

}  // namespace
}  // namespace cairn
