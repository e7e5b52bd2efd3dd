// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/stretches.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace cairn {
namespace {

/// Returns a pose `x` metres along z.
StampedPose pose_at(double seconds, double z) {
  return {static_cast<std::int64_t>(1e9 * seconds),
          WorldFromCamera(Rigid3{Eigen::Quaterniond::Identity(), {0, 0, z}})};
}

Trajectory drive(double seconds, double rate_hz) {
  Trajectory trajectory;
  for (int i = 0; i <= static_cast<int>(seconds * rate_hz); ++i)
    trajectory.push_back(pose_at(i / rate_hz, 3.0 * i / rate_hz));
  return trajectory;
}

TEST(CutStretches, follow_one_another_without_overlap) {
  const std::vector<Stretch> stretches = cut_stretches(drive(20, 10));
  ASSERT_EQ(stretches.size(), 20U);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    EXPECT_EQ(stretches[i].first_ns, static_cast<std::int64_t>(i) * 1'000'000'000);
    EXPECT_EQ(stretches[i].last_ns, stretches[i].first_ns + 1'000'000'000);
    EXPECT_NEAR(stretches[i].first_from_last.translation.z(), 3, 1e-9);
  }
}

TEST(CutStretches, last_from_half_a_second_to_two) {
  EXPECT_EQ(cut_stretches(drive(5, 10)).size(), 10U);
  EXPECT_EQ(cut_stretches(drive(100, 10)).size(), 50U);
  EXPECT_EQ(cut_stretches(drive(100, 0.4)).size(), 40U);  // neighbours, 2.5 s apart
  EXPECT_TRUE(cut_stretches(drive(100, 0.2)).empty());    // 5 s apart
}

TEST(CutStretches, never_bridge_a_gap) {
  Trajectory trajectory = drive(20, 10);
  trajectory.erase(trajectory.begin() + 55, trajectory.begin() + 62);
  const std::vector<Stretch> stretches = cut_stretches(trajectory);
  EXPECT_EQ(stretches.size(), 18U);
  for (const Stretch& stretch : stretches)
    EXPECT_TRUE(stretch.last_ns <= 5'500'000'000 || stretch.first_ns >= 6'200'000'000);
}

TEST(CutStretches, leave_out_a_standing_camera) {
  Trajectory trajectory = drive(20, 10);
  const double end = trajectory.back().world_from_camera.translation.z();
  for (int i = 1; i <= 200; ++i) trajectory.push_back(pose_at(20 + 0.1 * i, end));
  EXPECT_EQ(cut_stretches(trajectory).size(), 10U);  // of 2 s
}

TEST(CutStretches, need_two_poses) {
  EXPECT_TRUE(cut_stretches({}).empty());
  EXPECT_TRUE(cut_stretches({pose_at(0, 0)}).empty());
}

}  // namespace
}  // namespace cairn
