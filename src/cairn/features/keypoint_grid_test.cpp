// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/keypoint_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<Keypoint> random_keypoints(std::size_t count, double width, double height, std::uint64_t seed) {
  Random random(seed);
  std::vector<Keypoint> keypoints(count);
  for (Keypoint& keypoint : keypoints) {
    keypoint.u = static_cast<float>(random.uniform(0, width));
    keypoint.v = static_cast<float>(random.uniform(0, height));
  }
  return keypoints;
}

std::vector<std::int32_t> slow_find(const std::vector<Keypoint>& keypoints, double u, double v,
                                    double radius) {
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const double du = static_cast<double>(keypoints[i].u) - u, dv = static_cast<double>(keypoints[i].v) - v;
    if (du * du + dv * dv <= radius * radius) indices.push_back(static_cast<std::int32_t>(i));
  }
  return indices;
}

void expect_as_slow(const std::vector<Keypoint>& keypoints) {
  const KeypointGrid grid(keypoints);
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const double u = random.uniform(-100, 800), v = random.uniform(-100, 600);
    for (const double radius : {0.0, 3.0, 17.5, 200.0, 1e30}) {
      std::vector<std::int32_t> found;
      grid.find(u, v, radius, found);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, slow_find(keypoints, u, v, radius)) << u << ' ' << v << ' ' << radius;
    }
  }
}

TEST(KeypointGrid, finds_what_looking_at_all_finds) {
  expect_as_slow(random_keypoints(1000, 640, 480, 1));
  expect_as_slow(random_keypoints(20, 640, 1, 2));
  expect_as_slow(random_keypoints(1, 640, 480, 3));
  expect_as_slow({});
}

TEST(KeypointGrid, places_far_apart_take_no_memory_and_are_found) {
  auto keypoints = random_keypoints(100, 640, 480, 1);
  keypoints[3].u = 1e30F, keypoints[4].v = -3e38F;
  expect_as_slow(keypoints);
}

TEST(KeypointGrid, finds_a_keypoint_at_the_very_place) {
  const auto keypoints = random_keypoints(100, 640, 480, 1);
  const KeypointGrid grid(keypoints);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    std::vector<std::int32_t> found;
    grid.find(static_cast<double>(keypoints[i].u), static_cast<double>(keypoints[i].v), 0, found);
    EXPECT_EQ(found, std::vector<std::int32_t>{static_cast<std::int32_t>(i)});
  }
}

TEST(KeypointGrid, what_is_not_finite_is_nowhere) {
  auto keypoints = random_keypoints(10, 100, 100, 1);
  keypoints[0].u = kNan, keypoints[1].v = kInfinity, keypoints[2].u = -kInfinity;
  expect_as_slow(keypoints);
  const KeypointGrid grid(keypoints);
  std::vector<std::int32_t> found;
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  grid.find(nan, 50, 100, found);
  grid.find(50, infinity, 100, found);
  grid.find(50, 50, nan, found);
  grid.find(50, 50, -1, found);
  EXPECT_TRUE(found.empty());
  grid.find(50, 50, infinity, found);
  EXPECT_EQ(found.size(), 7U);
  const std::vector<Keypoint> none(3, Keypoint{kNan, kNan});
  const KeypointGrid empty(none);
  empty.find(0, 0, infinity, found);
  EXPECT_EQ(found.size(), 7U);
}

}  // namespace
}  // namespace cairn
