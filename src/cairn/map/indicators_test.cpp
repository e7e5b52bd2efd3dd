// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/indicators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr Rig kRig{100, 100, 50, 50, 0.1};

PosedObservation view_from(double x, double u, double v) {
  const WorldFromCamera world_from_camera({Eigen::Quaterniond::Identity(), {x, 0, 0}});
  return {world_from_camera.inverse(), {u, v}};
}

TEST(Indicators, tell_how_a_landmark_was_seen) {
  // The second camera is 3 m further right: straight before the point.
  const std::vector<PosedObservation> views{view_from(0, 125, 50), view_from(3, 50, 52)};
  const LandmarkIndicators found = indicators_of(kRig, {3, 0, 4}, views);
  const double angle = std::atan2(3.0, 4.0) * 180 / M_PI;
  EXPECT_EQ(found.frames, 2);
  EXPECT_NEAR(found.rms_px, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(found.max_ray_angle_deg, angle, 1e-9);
  const auto expect_range = [](const ValueRange& range, double low, double high) {
    EXPECT_NEAR(range.mean, (low + high) / 2, 1e-12);
    EXPECT_NEAR(range.min, low, 1e-12);
    EXPECT_NEAR(range.max, high, 1e-12);
    EXPECT_NEAR(range.std, (high - low) / 2, 1e-12);
  };
  expect_range(found.distance, 4, 5);
  expect_range(found.lateral, 0, 3);
  expect_range(found.depth, 4, 4);
  expect_range(found.angle_deg, 0, angle);
}

TEST(Indicators, the_largest_angle_is_of_any_two_rays) {
  const std::vector<PosedObservation> views{view_from(-1, 0, 0), view_from(0, 0, 0), view_from(1, 0, 0)};
  EXPECT_NEAR(indicators_of(kRig, {0, 0, 1}, views).max_ray_angle_deg, 90, 1e-9);
  EXPECT_EQ(indicators_of(kRig, {0, 0, 1}, std::vector{views[1]}).max_ray_angle_deg, 0);
  const std::vector<PosedObservation> close{view_from(0, 0, 0), view_from(1e-9, 0, 0)};
  EXPECT_NEAR(indicators_of(kRig, {0, 0, 1}, close).max_ray_angle_deg, 1e-9 * 180 / M_PI, 1e-12);
}

TEST(Indicators, a_landmark_behind_a_camera_is_infinitely_wrong) {
  EXPECT_EQ(indicators_of(kRig, {0, 0, -1}, std::vector{view_from(0, 50, 50)}).rms_px, INFINITY);
  EXPECT_THROW((void)indicators_of(kRig, {0, 0, 1}, {}), PreconditionError);
}

TEST(Indicators, the_largest_std_is_along_the_worst_direction) {
  const Eigen::Matrix3d turn = rotation_exp({0.3, -0.7, 1.1}).toRotationMatrix();
  const Eigen::Matrix3d covariance = turn * Eigen::Vector3d(0.01, 0.25, 0.04).asDiagonal() * turn.transpose();
  EXPECT_NEAR(largest_std(covariance), 0.5, 1e-12);
  EXPECT_EQ(largest_std(Eigen::Matrix3d::Zero()), 0);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(largest_std(Eigen::Vector3d(1, infinite, 1).asDiagonal()), infinite);
}

}  // namespace
}  // namespace cairn
