// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/random_points.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace cairn::testkit {
namespace {

constexpr SimulatedCamera kCamera{{500, 510, 320, 240, 0.1}, 640, 480};

TEST(RandomPoints, are_drawn_in_the_order_x_y_z) {
  Random random(3), same(3);
  const Eigen::Vector3d normal = normal_vector(random, 2),
                        uniform = point_in_box(random, {0, 1, 2}, {3, 5, 7});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(normal[i], 2 * same.normal()) << i;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(uniform[i], same.uniform(i, 3 + 2 * i)) << i;
}

TEST(RandomPoints, in_view_fill_the_image_and_the_depths) {
  Random random(4);
  Eigen::Array3d lowest = Eigen::Array3d::Constant(1e9), highest = -lowest;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point = kCamera.point_in_view(random, 2, 6);
    const Eigen::Vector3d pixels = kCamera.rig.project(point);
    EXPECT_TRUE(kCamera.shows(pixels));
    lowest = lowest.min(Eigen::Array3d(pixels.x(), pixels.y(), point.z()));
    highest = highest.max(Eigen::Array3d(pixels.x(), pixels.y(), point.z()));
  }
  EXPECT_TRUE((lowest < Eigen::Array3d(5, 5, 2.05)).all()) << lowest;
  EXPECT_TRUE((highest > Eigen::Array3d(634, 474, 5.95)).all()) << highest;
}

TEST(RandomPoints, a_camera_shows_what_lies_between_the_outermost_pixels) {
  EXPECT_TRUE(kCamera.shows({0, 0, 1}));
  EXPECT_TRUE(kCamera.shows({639, 479, 1}));
  for (const Eigen::Vector3d& outside :
       {Eigen::Vector3d(-0.1, 9, 1), {9, -0.1, 1}, {639.1, 9, 1}, {9, 479.1, 1}})
    EXPECT_FALSE(kCamera.shows(outside)) << outside.transpose();
}

TEST(RandomPoints, observations_have_the_noise_that_is_asked_for) {
  constexpr int kCount = 20'000;
  Random random(5);
  const PixelNoise noise{.sigma_px = 2, .sigma_d_px = 0.5, .scale = 1.5};
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  for (int i = 0; i < kCount; ++i) {
    const Observation seen = observe(random, {10, 20, 30}, noise);
    EXPECT_EQ(seen.sigma_px, 2);
    EXPECT_EQ(seen.sigma_d_px, 0.5);
    squares += Eigen::Array3d(seen.u - 10, seen.v - 20, seen.d - 30).square();
  }
  const Eigen::Array3d deviations = (squares / kCount).sqrt();
  const Eigen::Array3d wrong = (deviations / Eigen::Array3d(3, 3, 0.75) - 1).abs();
  EXPECT_LT(wrong.maxCoeff(), 0.03) << deviations;  // six standard deviations of the estimate
}

TEST(RandomPoints, an_observation_without_disparity_has_none) {
  Random random(6);
  Observation seen = observe(random, {10, 20, 30}, {}, false);
  EXPECT_FALSE(seen.has_disparity());
  mislead(random, 30, seen);
  EXPECT_FALSE(seen.has_disparity());
  seen = observe(random, {10, 20, 30}, {});
  EXPECT_TRUE(seen.has_disparity());
  forget_disparity(seen);
  EXPECT_FALSE(seen.has_disparity());
}

TEST(RandomPoints, a_wrong_match_is_one_to_three_times_aside) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    Observation seen = observe(random, {10, 20, 30}, {.scale = 0});
    mislead(random, 30, seen);
    const double aside = std::hypot(seen.u - 10, seen.v - 20);
    EXPECT_GE(aside, 30 - 1e-9);
    EXPECT_LE(aside, 90 + 1e-9);
  }
}

}  // namespace
}  // namespace cairn::testkit
