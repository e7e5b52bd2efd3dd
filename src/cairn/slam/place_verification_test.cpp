// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/place_verification.h"

#include <gtest/gtest.h>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/slam/map_maker.h"

namespace cairn {
namespace {

constexpr KeyframeId kReference{0};

/// A keyframe with all that it sees as landmarks.
testkit::MapMaker one_keyframe() {
  testkit::MapMaker maker(testkit::points_ahead(500, 2));
  (void)maker.add(testkit::aside(0));
  return maker;
}

TEST(VerifyPlace, places_a_frame_with_the_landmarks_that_it_shows) {
  testkit::MapMaker maker = one_keyframe();
  const testkit::View seen = maker.world.see(testkit::aside(0.2), 1);
  const auto placed = verify_place(maker.map, kReference, seen.observed, {});
  ASSERT_TRUE(placed);
  EXPECT_LT((placed->world_from_camera.translation - testkit::aside(0.2).translation).norm(), 5e-3);
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
  testkit::MapMaker maker = one_keyframe();
  const testkit::View seen = maker.world.see(testkit::aside(0.2), 1);
  SlamOptions near;
  near.max_loop_motion = 0.1;
  EXPECT_FALSE(verify_place(maker.map, kReference, seen.observed, near));
  for (testkit::WorldPoint& point : maker.world.points) point.look += 1000;
  const testkit::View other = maker.world.see(testkit::aside(0.2), 2);
  EXPECT_FALSE(verify_place(maker.map, kReference, other.observed, {}));
}

}  // namespace
}  // namespace cairn
