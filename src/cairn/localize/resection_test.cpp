// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/resection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"
#include "cairn/localize/precision.h"

namespace cairn {
namespace {

constexpr Rig kRig{500, 510, 320, 240, 0.2};

CameraFromWorld true_pose() {
  return CameraFromWorld({rotation_exp({0.1, -0.2, 0.05}), {0.3, -0.1, 0.5}});
}

/// Points before the camera whose map is off by their covariance, seen with noise.
std::vector<Sight> simulate(Random& random, int count, bool stereo) {
  std::vector<Sight> sights;
  const Rigid3 world_from_camera = true_pose().inverse();
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d in_camera(random.uniform(-2, 2), random.uniform(-1.5, 1.5), random.uniform(2, 12));
    const Eigen::Vector3d pixel = kRig.project(in_camera);
    Sight sight;
    const double sigma = i % 2 == 0 ? 0.005 : 0.15;  // some are poor
    sight.covariance = sigma * sigma * Eigen::Vector3d(1, 2, 0.5).asDiagonal().toDenseMatrix();
    const Eigen::Vector3d noise(random.normal(), std::sqrt(2.0) * random.normal(),
                                std::sqrt(0.5) * random.normal());
    sight.point_in_world = world_from_camera * in_camera + sigma * noise;
    sight.seen = {pixel.x() + random.normal(), pixel.y() + random.normal()};
    sight.seen.sigma_d_px = 0.5;
    if (stereo) sight.seen.d = pixel.z() + 0.5 * random.normal();
    sights.push_back(sight);
  }
  return sights;
}

TEST(Resection, its_covariance_is_honest) {
  for (const bool stereo : {true, false}) {
    Random random(3, stereo ? 1 : 0);
    double nees = 0, factor = 0;
    constexpr int kRuns = 200;
    for (int run = 0; run < kRuns; ++run) {
      const auto sights = simulate(random, 60, stereo);
      const Resection found = resect(kRig, sights, true_pose());
      ASSERT_TRUE(found.solved);
      const Vector6d error = left_perturbation(found.camera_from_world, true_pose());
      nees += error.dot(found.covariance.ldlt().solve(error)) / (6 * kRuns);
      factor += found.variance_factor / kRuns;
    }
    EXPECT_NEAR(nees, 1.0, 0.25) << stereo;
    EXPECT_NEAR(factor, 1.0, 0.1) << stereo;
  }
}

TEST(Resection, poor_landmarks_count_less) {
  Random random(4);
  double with = 0, without = 0;
  for (int run = 0; run < 50; ++run) {
    auto sights = simulate(random, 60, true);
    with +=
        left_perturbation(resect(kRig, sights, true_pose()).camera_from_world, true_pose()).tail<3>().norm();
    for (Sight& sight : sights) sight.covariance = 0.15 * 0.15 * Eigen::Matrix3d::Identity();  // all alike
    without +=
        left_perturbation(resect(kRig, sights, true_pose()).camera_from_world, true_pose()).tail<3>().norm();
  }
  EXPECT_LT(with, 0.9 * without);
}

TEST(Resection, the_whitened_derivative_is_the_errors) {
  Random random(5);
  const auto sights = simulate(random, 5, true);
  for (const Sight& sight : sights) {
    const WhitenedSight at = whiten(kRig, true_pose(), sight);
    Sight exact = sight;  // without its covariance, which moves with the pose
    exact.covariance.setZero();
    const WhitenedSight plain = whiten(kRig, true_pose(), exact);
    EXPECT_LT(at.error.norm(), plain.error.norm());
    for (int axis = 0; axis < 6; ++axis) {
      constexpr double kStep = 1e-6;
      const Vector6d step = kStep * Vector6d::Unit(axis);
      const Eigen::Vector3d slope = (whiten(kRig, perturb_left(step, true_pose()), exact).error -
                                     whiten(kRig, perturb_left(-step, true_pose()), exact).error) /
                                    (2 * kStep);
      EXPECT_LT((slope - plain.jacobian.col(axis)).norm(), 1e-4 * (1 + slope.norm()));
    }
  }
}

TEST(Resection, leaves_wrong_matches_out) {
  Random random(6);
  auto sights = simulate(random, 60, true);
  for (std::size_t i = 0; i < 20; ++i) sights[i].seen.u += 80;
  const Resection found = resect(kRig, sights, true_pose());
  ASSERT_TRUE(found.solved);
  for (const std::int32_t inlier : found.inliers) EXPECT_GE(inlier, 20);
  EXPECT_FALSE(resect(kRig, std::span(sights).first(3), true_pose()).solved);
}

TEST(Precision, dilution_follows_the_geometry) {
  Random random(7);
  const auto sights = simulate(random, 100, true);
  const auto mono = simulate(random, 100, false);
  const Precision all = assess_precision(kRig, sights, resect(kRig, sights, true_pose()));
  const auto half = std::span(sights).first(50);
  const Precision fewer = assess_precision(kRig, half, resect(kRig, half, true_pose()));
  EXPECT_NEAR(fewer.gdop / all.gdop, std::sqrt(2.0), 0.25);  // twice the observations
  EXPECT_NEAR(all.gdop, all.dilution.tail<3>().norm(), 1e-12);
  for (int axis = 0; axis < 6; ++axis) EXPECT_LT(all.protection[axis], fewer.protection[axis] * 1.05);
}

}  // namespace
}  // namespace cairn
