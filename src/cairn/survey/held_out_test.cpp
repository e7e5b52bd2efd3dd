// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/held_out.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

constexpr int kFrames = 12;
constexpr KeyframeId kHeldOut{7};

/// A drive past points, each a landmark that all frames show.
class HeldOut : public testing::Test {
 protected:
  void make(std::size_t points) {
    frames_ = testkit::drive(testkit::roadside_points(points), kFrames, 0.5);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(points); ++i) {
      const auto fitted =
          fit_observations(kDriveRig, frames_, testkit::observations_of(i, 0, kFrames - 1), {});
      ASSERT_TRUE(fitted.has_value());
      landmarks_.push_back(*fitted);
    }
  }
  void hold_out() {
    const SurveyOptions options;
    const NoisePrior prior{{1e3, 1}, {}};
    HoldOut hold_out(kDriveRig, options, prior, frames_);
    for (const SurveyLandmark& landmark : landmarks_) hold_out.add(landmark);
  }

  FrameBuffer frames_;
  std::vector<SurveyLandmark> landmarks_;
};

TEST_F(HeldOut, landmarks_are_solved_without_the_frame) {
  make(40);
  hold_out();
  const auto before = frames_[kHeldOut].held_out;
  ASSERT_EQ(before.size(), 40U);
  EXPECT_NE(before[3].point_in_world, landmarks_[3].point_in_world);
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(frames_[KeyframeId{i}].held_out.empty(), !is_held_out(KeyframeId{i})) << i;
    frames_[KeyframeId{i}].held_out.clear();
  }
  frames_[kHeldOut].observed.observations[3].u += 3;
  hold_out();
  EXPECT_EQ(frames_[kHeldOut].held_out[3].point_in_world, before[3].point_in_world);
  ASSERT_EQ(frames_[KeyframeId{4}].held_out.size(), 40U);
  EXPECT_NE(frames_[KeyframeId{4}].held_out[3].point_in_world, before[3].point_in_world);
}

TEST_F(HeldOut, landmarks_that_need_the_frame_are_left_out) {
  make(2);
  landmarks_[1].observations =
      testkit::observations_of(1, 6, 8);  // three frames, as many as a landmark needs
  hold_out();
  ASSERT_EQ(frames_[kHeldOut].held_out.size(), 1U);
  EXPECT_EQ(frames_[kHeldOut].held_out[0].feature, 0);
}

TEST_F(HeldOut, says_by_how_much_the_frame_is_missed) {
  make(300);
  SurveyFrame& frame = frames_[kHeldOut];
  frame.given.world_from_camera.translation += frame.world_from_camera.rotation * Eigen::Vector3d(0, 0, 0.05);
  frame.given.uncertainty.emplace();
  frame.given.uncertainty->position = 0.04 * Eigen::Matrix3d::Identity();
  hold_out();
  const auto found = locate_held_out(kDriveRig, frame, 0.5);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->keyframe, kHeldOut);
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_GT(found->formal[i], 0);
    EXPECT_LT(std::abs(found->to_map[i]), 4 * std::sqrt(found->formal[i]));
    EXPECT_NEAR(found->to_given[i] - found->to_map[i], i == 5 ? -0.05 : 0, 1e-4);
    EXPECT_NEAR(found->stated[i], i < 3 ? 0 : 0.04, 1e-12);
  }
}

/// The errors of poses move all landmarks of a place alike, which no number of them averages out: they are no
/// part of what single landmarks err by.
TEST_F(HeldOut, weighs_landmarks_without_what_they_have_in_common) {
  make(300);
  hold_out();
  const HeldOutFrame alone = locate_held_out(kDriveRig, frames_[kHeldOut], 0.5).value();
  frames_[kHeldOut].held_out.clear();
  for (SurveyLandmark& landmark : landmarks_) landmark.pose_covariance = 0.04 * Eigen::Matrix3d::Identity();
  hold_out();
  EXPECT_EQ(locate_held_out(kDriveRig, frames_[kHeldOut], 0.5)->formal, alone.formal);
}

TEST_F(HeldOut, is_nothing_of_a_few_landmarks) {
  make(49);
  hold_out();
  EXPECT_FALSE(locate_held_out(kDriveRig, frames_[kHeldOut], 0.5).has_value());
}

}  // namespace
}  // namespace cairn
