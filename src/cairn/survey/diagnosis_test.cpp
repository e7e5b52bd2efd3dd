// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cairn {
namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

SurveyResult without_landmarks() {
  SurveyResult result;
  result.counts.features = 900;
  result.counts.measured = 500;
  result.counts.tracks = 300;
  return result;
}

TEST(ExplainNoLandmarks, names_the_rule_that_most_fell_to) {
  SurveyResult result = without_landmarks();
  result.counts.tracks = 900;
  result.counts.too_short = 640;  // as many are of a good drive
  result.counts.inconsistent = 30;
  result.counts.cleaned[static_cast<std::size_t>(CleaningRule::ray_angle)] = 200;
  result.counts.cleaned[static_cast<std::size_t>(CleaningRule::rms)] = 30;
  result.stated = {1.5, 0.25};
  const std::string said = explain_no_landmarks(result, {});
  EXPECT_TRUE(says(said, "200 of 230")) << said;
  EXPECT_TRUE(says(said, "clean.min_ray_angle_deg (0.2)")) << said;
  EXPECT_TRUE(says(said, "1.5 m and 0.25 degrees")) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

TEST(ExplainNoLandmarks, names_what_is_lacking) {
  SurveyResult result = without_landmarks();
  result.counts.inconsistent = 280;
  result.counts.too_short = 20;
  EXPECT_TRUE(says(explain_no_landmarks(result, {}), "fits no point"));
  std::swap(result.counts.inconsistent, result.counts.too_short);
  EXPECT_TRUE(says(explain_no_landmarks(result, {}), "not found again"));
  result.counts.measured = 0;
  EXPECT_TRUE(says(explain_no_landmarks(result, {}), "None of 900 features has a depth"));
  result.counts.features = 0;
  EXPECT_TRUE(says(explain_no_landmarks(result, {}), "no features"));
}

TEST(DescribeDominantPoses, only_if_they_dominate_most) {
  SurveyResult result;
  result.counts.landmarks = 10;
  result.counts.dominated_by_poses = 5;
  EXPECT_EQ(describe_dominant_poses(result), "");
  result.counts.dominated_by_poses = 6;
  result.pose_std_rms_m = 0.04;
  result.image_std_rms_m = 0.08;
  EXPECT_EQ(describe_dominant_poses(result), "");
  result.pose_std_rms_m = 1.02;
  const std::string said = describe_dominant_poses(result);
  EXPECT_TRUE(says(said, "6 of 10") && says(said, "1 m") && says(said, "0.08 m")) << said;
}

TEST(StatedDeviations, are_medians_along_the_worst_direction) {
  GivenPoses poses;
  for (int i = 1; i <= 3; ++i) {
    GivenPose pose;
    pose.uncertainty = PoseUncertainty{};
    pose.uncertainty->position = Eigen::Vector3d(0.01, 1.0 * i * i, 0.01).asDiagonal();
    poses.frames.emplace_back(pose);
  }
  poses.frames.emplace_back();
  EXPECT_NEAR(stated_deviations(poses).position_m, 2, 1e-12);
  EXPECT_EQ(stated_deviations(poses).rotation_deg, 0);
  EXPECT_EQ(stated_deviations({}).position_m, 0);
}

}  // namespace
}  // namespace cairn
