// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/place_verification.h"

#include <gtest/gtest.h>

#include "cairn/slam/test_map.h"

namespace cairn {
namespace {

constexpr KeyframeId kReference{0};

/// A keyframe with all that it sees as landmarks.
test::MapMaker one_keyframe() {
  test::MapMaker maker(test::points_ahead(500, 2));
  (void)maker.add(test::aside(0));
  return maker;
}

TEST(VerifyPlace, places_a_frame_with_the_landmarks_that_it_shows) {
  test::MapMaker maker = one_keyframe();
  const test::View seen = maker.world.see(test::aside(0.2), 1);
  const auto placed = verify_place(maker.map, kReference, seen.observed, {});
  ASSERT_TRUE(placed);
  EXPECT_LT((placed->world_from_camera.translation - test::aside(0.2).translation).norm(), 5e-3);
  ASSERT_EQ(placed->landmarks.size(), seen.points.size());
  int right = 0;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    if (!placed->landmarks[i].valid()) continue;
    EXPECT_EQ(placed->landmarks[i], maker.known[seen.points[i]].landmark);
    ++right;
  }
  EXPECT_EQ(right, placed->inliers);
  EXPECT_GT(right, 100);
  EXPECT_GE(placed->matches, placed->inliers);
}

TEST(VerifyPlace, refuses_another_place_and_one_too_far_away) {
  test::MapMaker maker = one_keyframe();
  const test::View seen = maker.world.see(test::aside(0.2), 1);
  SlamOptions near;
  near.max_loop_motion = 0.1;
  EXPECT_FALSE(verify_place(maker.map, kReference, seen.observed, near));
  for (test::WorldPoint& point : maker.world.points) point.look += 1000;
  const test::View other = maker.world.see(test::aside(0.2), 2);
  EXPECT_FALSE(verify_place(maker.map, kReference, other.observed, {}));
}

}  // namespace
}  // namespace cairn
