// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/epipolar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr Rig kRig{100, 100, 40, 30, 0.5};

Rigid3 moved(const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond::Identity(), translation};
}

TEST(EpipolarDistance, of_a_sideways_motion_the_line_is_the_row) {
  EXPECT_NEAR(epipolar_distance(kRig, moved({-1, 0, 0}), {40, 30}, {90, 37}), 7, 1e-12);
  EXPECT_NEAR(epipolar_distance(kRig, moved({-1, 0, 0}), {10, 12}, {90, 9}), 3, 1e-12);
}

TEST(EpipolarDistance, of_a_forward_motion_the_line_goes_through_the_centre) {
  // The line through (40, 30) and (43, 34); (20, 45) is 25 away from the centre at a right angle to it.
  EXPECT_NEAR(epipolar_distance(kRig, moved({0, 0, -1}), {43, 34}, {46, 38}), 0, 1e-12);
  EXPECT_NEAR(epipolar_distance(kRig, moved({0, 0, -1}), {43, 34}, {20, 45}), 25, 1e-12);
}

TEST(EpipolarDistance, focal_lengths_may_differ) {
  const Rig rig{100, 200, 40, 30, 0.5};
  // Of the ray (0.3, 0.2, 1) the line is 0.2 x = 0.3 y in rays; in pixels from the centre 0.2 u / 100 = 0.3 v
  // / 200: the direction (3, 4).
  EXPECT_NEAR(epipolar_distance(rig, moved({0, 0, -1}), {70, 70}, {46, 38}), 0, 1e-12);
  EXPECT_NEAR(epipolar_distance(rig, moved({0, 0, -1}), {70, 70}, {32, 36}), 10, 1e-12);
}

TEST(EpipolarDistance, without_translation_there_is_no_line) {
  EXPECT_TRUE(std::isnan(
      epipolar_distance(kRig, {rotation_exp({0.1, 0.2, 0.3}), Eigen::Vector3d::Zero()}, {10, 12}, {20, 9})));
}

TEST(EpipolarDistance, of_the_epipole_there_is_no_line) {
  EXPECT_TRUE(std::isnan(epipolar_distance(kRig, moved({0, 0, -1}), {40, 30}, {20, 9})));
}

TEST(EpipolarDistance, is_zero_both_ways_for_one_point) {
  Random random(1);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size),
                           random.uniform(-size, size));
  };
  for (int i = 0; i < 100; ++i) {
    const Rigid3 b_from_a{rotation_exp(vector(0.4)), vector(1)};
    const Eigen::Vector3d in_a = vector(2) + Eigen::Vector3d(0, 0, 8);
    const Eigen::Vector2d a = kRig.project(in_a).head<2>(), b = kRig.project(b_from_a * in_a).head<2>();
    EXPECT_NEAR(epipolar_distance(kRig, b_from_a, a, b), 0, 1e-9);
    EXPECT_NEAR(epipolar_distance(kRig, b_from_a.inverse(), b, a), 0, 1e-9);
  }
}

TEST(EpipolarDistance, does_not_change_with_the_length_of_the_way) {
  const Eigen::Quaterniond rotation = rotation_exp({0.1, -0.2, 0.05});
  const Eigen::Vector3d way(0.3, 0.1, -0.9);
  const Eigen::Vector2d a(12, 50), b(60, 17);
  const double distance = epipolar_distance(kRig, {rotation, way}, a, b);
  EXPECT_GT(distance, 1);
  for (const double factor : {-1.0, 0.01, 30.0})
    EXPECT_NEAR(epipolar_distance(kRig, {rotation, factor * way}, a, b), distance, 1e-9);
}

}  // namespace
}  // namespace cairn
