// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/duplicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

/// Features 0, 1 and 2 show one thing (a corner that was found thrice), feature 3 something that looks
/// different at the same place, feature 4 something that looks the same two metres aside.
class MergeDuplicates : public testing::Test {
 protected:
  static std::vector<testkit::DrivePoint> points() {
    const Eigen::Vector3d place(2, -0.5, 22);
    return {{place, 1}, {place, 1}, {place, 1}, {place, 8}, {place + Eigen::Vector3d(2, 0, 0), 1}};
  }
  [[nodiscard]] SurveyLandmark landmark(std::int32_t feature, int first, int last) const {
    auto fitted =
        fit_observations(kDriveRig, frames_, testkit::observations_of(feature, first, last), options_);
    EXPECT_TRUE(fitted.has_value());
    if (!fitted) return {};
    complete_covariance(frames_, {prior_, {}}, true, *fitted);
    return *fitted;
  }
  std::int64_t merge(std::vector<SurveyLandmark>&& added) {
    return merge_duplicates({kDriveRig, frames_, prior_, options_}, std::move(added), pending_);
  }

  FrameBuffer frames_ = testkit::drive(points(), 14, 0.3);
  VariancePrior prior_;
  SurveyOptions options_;
  std::vector<SurveyLandmark> pending_;
};

TEST_F(MergeDuplicates, what_is_one_becomes_one) {
  const SurveyLandmark early = landmark(0, 0, 5), late = landmark(1, 6, 11);
  EXPECT_EQ(merge({early}), 0);
  EXPECT_EQ(merge({late}), 1);
  ASSERT_EQ(pending_.size(), 1U);
  std::vector<ObservationRef> both = early.observations;
  both.insert(both.end(), late.observations.begin(), late.observations.end());
  EXPECT_EQ(pending_[0].observations, both);
  EXPECT_EQ(pending_[0].indicators.frames, 12);
  EXPECT_LT((pending_[0].point_in_world - points()[0].position).norm(), 0.3);
  EXPECT_LT(pending_[0].covariance().trace(), early.covariance().trace());
  EXPECT_LT(pending_[0].covariance().trace(), late.covariance().trace());
  EXPECT_EQ(pending_[0].variance_factor,
            prior_.factor(pending_[0].squared_error_sum, pending_[0].redundancy));
}

TEST_F(MergeDuplicates, in_a_common_frame_the_earlier_ones_observation_stays) {
  merge({landmark(0, 0, 5)});
  EXPECT_EQ(merge({landmark(1, 4, 9)}), 1);
  ASSERT_EQ(pending_.size(), 1U);
  std::vector<ObservationRef> both = testkit::observations_of(0, 0, 5);
  for (const ObservationRef& observation : testkit::observations_of(1, 6, 9)) both.push_back(observation);
  EXPECT_EQ(pending_[0].observations, both);
}

TEST_F(MergeDuplicates, what_looks_different_stays_two) {
  EXPECT_EQ(merge({landmark(0, 0, 5), landmark(3, 4, 9)}), 0);
  EXPECT_EQ(pending_.size(), 2U);
}

TEST_F(MergeDuplicates, what_is_apart_stays_two) {
  EXPECT_EQ(merge({landmark(0, 0, 5), landmark(4, 6, 11)}), 0);
  EXPECT_EQ(pending_.size(), 2U);
}

TEST_F(MergeDuplicates, uncertain_ones_that_one_point_does_not_fit_stay_two) {
  // Their covariances reach across the two metres, their observations do not.
  SurveyLandmark here = landmark(0, 0, 5), there = landmark(4, 6, 11);
  here.cofactor = there.cofactor = 4 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(merge({here, there}), 0);
  EXPECT_EQ(pending_.size(), 2U);
}

TEST_F(MergeDuplicates, the_errors_of_poses_do_not_make_one_of_two) {
  // They move both alike.
  SurveyLandmark here = landmark(0, 0, 5), there = landmark(4, 0, 5);
  there.observations = testkit::observations_of(0, 6, 11);
  here.pose_covariance = there.pose_covariance = 4 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(merge({here, there}), 0);
}

TEST_F(MergeDuplicates, a_landmark_spans_fewer_frames_than_the_most) {
  options_.tracks.max_frames = 12;
  EXPECT_EQ(merge({landmark(0, 0, 5), landmark(1, 6, 11)}), 0);
  EXPECT_EQ(pending_.size(), 2U);
  pending_.clear();
  options_.tracks.max_frames = 13;
  EXPECT_EQ(merge({landmark(0, 0, 5), landmark(1, 6, 11)}), 1);
}

TEST_F(MergeDuplicates, a_chain_becomes_one) {
  EXPECT_EQ(merge({landmark(0, 0, 4), landmark(1, 5, 8), landmark(2, 9, 12)}), 2);
  ASSERT_EQ(pending_.size(), 1U);
  EXPECT_EQ(pending_[0].observations.size(), 13U);
  EXPECT_EQ(pending_[0].observations.back(), (ObservationRef{{12}, 2}));
}

TEST_F(MergeDuplicates, what_would_break_a_limit_of_cleaning_stays_two) {
  const SurveyLandmark early = landmark(0, 0, 5), late = landmark(1, 6, 11);
  std::vector<SurveyLandmark> both{early};
  EXPECT_EQ(merge_duplicates({kDriveRig, frames_, prior_, options_}, {late}, both), 1);
  const LandmarkIndicators merged = both.front().indicators;
  const double worst_alone = std::max(early.indicators.rms_px, late.indicators.rms_px);
  const double depth_alone = std::max(early.indicators.depth.std, late.indicators.depth.std);
  ASSERT_GT(merged.depth.std, depth_alone);  // each one's hold against the limits between
  options_.cleaning.depth.max_std = (merged.depth.std + depth_alone) / 2;
  EXPECT_EQ(merge({early, late}), 0);
  ASSERT_EQ(pending_.size(), 2U);
  options_.cleaning.depth.max_std.reset();
  pending_.clear();
  options_.cleaning.max_rms_px = std::min(merged.rms_px, worst_alone) * 0.99;
  EXPECT_EQ(merge({early, late}), 0);
}

TEST_F(MergeDuplicates, no_sigmas_no_merging) {
  options_.cleaning.duplicate_sigmas = 0;
  EXPECT_EQ(merge({landmark(0, 0, 5), landmark(1, 6, 11)}), 0);
}

}  // namespace
}  // namespace cairn
