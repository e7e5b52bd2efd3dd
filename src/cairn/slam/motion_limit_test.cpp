// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/motion_limit.h"

#include <gtest/gtest.h>

#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/map/point_world.h"

namespace cairn {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

SlamOptions limit(double max_motion, double frame_period_s) {
  SlamOptions options;
  options.max_motion = max_motion;
  options.frame_period_s = frame_period_s;
  return options;
}

TEST(MotionLimit, is_for_each_frame_period) {
  const SlamOptions options = limit(0.5, 0.1);
  EXPECT_EQ(steps_between(0, kSecond / 10, options), 1);
  EXPECT_EQ(steps_between(0, kSecond / 100, options), 1) << "never less than a step";
  EXPECT_NEAR(steps_between(2 * kSecond, 3 * kSecond, options), 10, 1e-9);
  EXPECT_EQ(steps_between(0, kSecond, limit(0.5, 0)), 1) << "the period is not known";
  EXPECT_TRUE(is_plausible_motion(testkit::aside(0.4), 0, kSecond / 10, options));
  EXPECT_FALSE(is_plausible_motion(testkit::aside(0.6), 0, kSecond / 10, options));
  EXPECT_TRUE(is_plausible_motion(testkit::aside(0.6), 0, 2 * kSecond / 10, options));
  const Rigid3 turned{rotation_exp({0, 0.3, 0}), {0.3, 0, 0}};
  EXPECT_FALSE(is_plausible_motion(turned, 0, kSecond / 10, options)) << "rotation and translation add up";
}

TEST(KnownPoses, judge_by_the_last_pose_in_the_same_component) {
  Map map(testkit::kWorldRig, "ORB");
  const KeyframeId a = map.add_keyframe(testkit::blank_frame(4), {}, {}, 0);
  const KeyframeId b = map.add_keyframe(testkit::blank_frame(4, 1), testkit::aside(100), {}, 1);
  const SlamOptions options = limit(0.5, 0.1);
  KnownPoses known;
  EXPECT_TRUE(known.allow(map, a, testkit::aside(50), 0, options)) << "nothing is known";
  known.remember(map, a, testkit::aside(0.2), 0);
  EXPECT_TRUE(known.allow(map, a, testkit::aside(0.6), kSecond / 10, options));
  EXPECT_FALSE(known.allow(map, a, testkit::aside(0.8), kSecond / 10, options));
  EXPECT_TRUE(known.allow(map, a, testkit::aside(0.8), 2 * kSecond / 10, options)) << "two periods later";
  EXPECT_TRUE(known.allow(map, b, testkit::aside(103), kSecond / 10, options))
      << "none is known in that part";
  known.remember(map, b, {}, kSecond);
  EXPECT_FALSE(known.allow(map, b, testkit::aside(101), kSecond + kSecond / 10, options));
  EXPECT_FALSE(known.allow(map, a, testkit::aside(6), kSecond, options)) << "the other part's is still known";
}

TEST(KnownPoses, move_with_their_keyframe) {
  Map map(testkit::kWorldRig, "ORB");
  const KeyframeId a = map.add_keyframe(testkit::blank_frame(4), {}, {}, 0);
  KnownPoses known;
  known.remember(map, a, testkit::aside(0.2), 0);
  map.move(a, testkit::aside(10));
  EXPECT_TRUE(known.allow(map, a, testkit::aside(10.4), kSecond / 10, limit(0.5, 0.1)));
  EXPECT_FALSE(known.allow(map, a, testkit::aside(0.4), kSecond / 10, limit(0.5, 0.1)));
}

class JoinTest : public testing::Test {
 protected:
  KeyframeId add(std::int32_t frame, double x, std::int32_t component) {
    ObservedFrame observed = testkit::blank_frame(4, frame);
    observed.stamp_ns = frame * kSecond / 10;
    return map_.add_keyframe(std::move(observed), testkit::aside(x), {}, component);
  }
  Map map_{testkit::kWorldRig, "ORB"};
};

TEST_F(JoinTest, components_need_a_plausible_way_from_one_to_the_other) {
  add(0, 0, 0);
  add(1, 0.3, 0);
  add(5, 0, 1);  // 4 periods later
  EXPECT_TRUE(can_be_joined(map_, 0, 1, testkit::aside(2.2), limit(0.5, 0.1)));
  EXPECT_FALSE(can_be_joined(map_, 0, 1, testkit::aside(2.4), limit(0.5, 0.1)));
  EXPECT_TRUE(can_be_joined(map_, 1, 0, testkit::aside(-2.2), limit(0.5, 0.1))) << "the other way around";
  EXPECT_FALSE(can_be_joined(map_, 1, 0, testkit::aside(-2.4), limit(0.5, 0.1)));
}

TEST_F(JoinTest, keyframes_of_an_earlier_recording_have_no_time) {
  add(0, 0, 0);
  map_.end_recording();
  add(1, 0, 1);
  EXPECT_TRUE(can_be_joined(map_, 0, 1, testkit::aside(50), limit(0.5, 0.1)));
}

}  // namespace
}  // namespace cairn
