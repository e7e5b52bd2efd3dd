// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/motion_check.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr std::int64_t kTenth = 100'000'000;

Localization good_at(double x) {
  Localization found;
  found.verdict = Verdict::good;
  found.camera_from_world = WorldFromCamera({Eigen::Quaterniond::Identity(), {x, 0, 0}}).inverse();
  found.precision.protection.setConstant(0.05);
  return found;
}

TEST(MotionCheck, a_jump_is_not_believed) {
  MotionCheck check{TrustOptions()};
  for (int i = 0; i < 5; ++i) {
    Localization found = good_at(1.5 * i);  // 15 m/s
    check.check(i * kTenth, found);
    EXPECT_EQ(found.verdict, Verdict::good) << i;
  }
  Localization jumped = good_at(7.5 + 3);
  check.check(5 * kTenth, jumped);
  EXPECT_EQ(jumped.verdict, Verdict::weak);
  EXPECT_EQ(jumped.weakness, Weakness::inconsistent_with_motion);
}

TEST(MotionCheck, a_turn_on_the_spot_is_not_believed) {
  MotionCheck check{TrustOptions()};
  for (int i = 0; i < 3; ++i) {
    Localization found = good_at(0);
    if (i == 2) found.camera_from_world = CameraFromWorld({rotation_exp({0, 2, 0}), Eigen::Vector3d::Zero()});
    check.check(i * kTenth, found);
    EXPECT_EQ(found.verdict == Verdict::good, i < 2) << i;
  }
}

TEST(MotionCheck, images_far_apart_in_time_may_be_far_apart) {
  MotionCheck check{TrustOptions()};
  for (int i = 0; i < 4; ++i) {
    Localization found = good_at(i % 2 == 0 ? 0 : 30);
    check.check(i * 100 * kTenth, found);
    EXPECT_EQ(found.verdict, Verdict::good) << i;
  }
}

TEST(MotionCheck, images_without_a_pose_are_passed_over) {
  MotionCheck check{TrustOptions()};
  Localization none;
  check.check(0, none);
  EXPECT_EQ(none.verdict, Verdict::none);
}

}  // namespace
}  // namespace cairn
