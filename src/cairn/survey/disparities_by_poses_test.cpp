// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/disparities_by_poses.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cairn/simulate/write_kitti.h"
#include "cairn/simulate/write_tum.h"
#include "cairn/testing/survey/street_survey.h"

namespace cairn {
namespace {

using testkit::small_street;
using testkit::small_window;

/// Simulates a street whose right camera is turned about its vertical axis.
class CalibrateByPoses : public testing::Test {
 protected:
  [[nodiscard]] DisparityCalibration calibrate(double yaw_deg, const SurveyOptions& options = small_window(),
                                               int threads = 2) {
    SimulateStreetOptions street = small_street(kFrames);
    street.right_rotation_deg.y() = yaw_deg;
    const auto folder = scratch_.make_folder("street");
    Progress silent;
    const Executor executor(threads);
    (void)write_kitti(SimulatedStreet(street, executor), folder, false, executor, silent);
    const Sequence sequence = open_sequence(folder);
    GivenPoses poses = read_given_poses(sequence);
    if (without_poses_) poses.frames.assign(poses.frames.size(), std::nullopt);
    for (auto& pose : poses.frames)
      if (pose) err(*pose);
    return calibrate_by_poses(sequence, poses, options, executor);
  }

  /// Makes a pose wrong as all others are: by a scale of the path.
  void err(GivenPose& pose) const {
    pose.world_from_camera.translation *= path_scale_;
    if (stated_std_m_ == 0) return;
    pose.uncertainty.emplace();
    pose.uncertainty->position = stated_std_m_ * stated_std_m_ * Eigen::Matrix3d::Identity();
    pose.uncertainty->rotation = 1e-6 * Eigen::Matrix3d::Identity();
  }

  static constexpr int kFrames = 24;
  bool without_poses_ = false;
  double path_scale_ = 1;    // given over true
  double stated_std_m_ = 0;  // of the given centres; 0: not stated
  const testkit::TemporaryFolder scratch_;
};

TEST_F(CalibrateByPoses, finds_what_a_turned_camera_adds) {
  constexpr double kYaw = 0.1;                                    // degrees
  constexpr double kAdded = 240 * kYaw * std::numbers::pi / 180;  // pixels, in the middle
  const DisparityCalibration found = calibrate(kYaw);
  EXPECT_TRUE(found.is_determined());
  EXPECT_TRUE(found.applied);
  EXPECT_NEAR(found.field[0], kAdded, 0.05);
  EXPECT_NEAR(found.field[2], kAdded, 3 * found.sigma[2]);
}

TEST_F(CalibrateByPoses, finds_nothing_where_nothing_is_wrong) {
  const DisparityCalibration found = calibrate(0);
  EXPECT_TRUE(found.is_determined());
  EXPECT_LT(found.rms_px, 0.05);
  EXPECT_FALSE(found.applied);
}

TEST_F(CalibrateByPoses, applies_nothing_that_is_only_to_be_reported) {
  SurveyOptions options = small_window();
  options.observer.stereo_noise.self_calibration = "report";
  const DisparityCalibration found = calibrate(0.1, options);
  EXPECT_TRUE(found.should_be_applied());
  EXPECT_FALSE(found.applied);
  options.observer.stereo_noise.self_calibration = "off";
  EXPECT_EQ(calibrate(0.1, options).estimates, 0);
}

TEST_F(CalibrateByPoses, does_nothing_without_poses) {
  without_poses_ = true;
  EXPECT_EQ(calibrate(0.1).estimates, 0);
}

TEST_F(CalibrateByPoses, takes_nothing_for_a_field_that_the_poses_say_may_be_theirs) {
  path_scale_ = 1.05;
  const DisparityCalibration held = calibrate(0);
  EXPECT_GT(held.rms_px, 0.3);  // poses that state no deviations are exact
  stated_std_m_ = 1;
  const DisparityCalibration free = calibrate(0);
  EXPECT_LT(free.rms_px, 0.3 * held.rms_px);
  EXPECT_FALSE(free.applied);
}

TEST_F(CalibrateByPoses, finds_what_a_turned_camera_adds_by_poses_with_small_deviations) {
  stated_std_m_ = 0.01;
  const DisparityCalibration found = calibrate(0.1);
  EXPECT_TRUE(found.applied);
  EXPECT_NEAR(found.field[0], 240 * 0.1 * std::numbers::pi / 180, 0.06);
}

TEST_F(CalibrateByPoses, gives_the_same_bits_at_any_number_of_threads) {
  EXPECT_EQ(calibrate(0.1, small_window(), 1).field, calibrate(0.1, small_window(), 3).field);
}

/// Simulates a small room whose depth has `factor` times a Kinect's noise.
class DepthNoiseByPoses : public testing::Test {
 protected:
  [[nodiscard]] std::optional<DisparityNoiseEstimate> estimate(double factor,
                                                               const SurveyOptions& options = {},
                                                               int threads = 2) {
    SimulateRoomOptions room;
    room.frames_count = 24;
    room.camera = resized(room.camera, 0.5);
    room.depth_noise = factor;
    const auto folder = scratch_.make_folder("room");
    Progress silent;
    const Executor executor(threads);
    (void)write_tum(SimulatedRoom(room, executor), folder, executor, silent);
    const Sequence sequence = open_sequence(folder);
    return depth_noise_by_poses(sequence, read_given_poses(sequence), options, executor);
  }

  const testkit::TemporaryFolder scratch_;
};

TEST_F(DepthNoiseByPoses, finds_how_noisy_depth_is) {
  const auto found = estimate(5);
  ASSERT_TRUE(found);
  EXPECT_GT(found->disparities, 1000);
  for (const double depth : {2.0, 3.0})
    EXPECT_NEAR(found->noise.of_depth(found->rig, depth), 5 * kinect_depth_deviation(depth),
                0.3 * 5 * kinect_depth_deviation(depth))
        << depth;
}

TEST_F(DepthNoiseByPoses, is_the_same_at_any_number_of_threads) {
  const auto one = estimate(2, {}, 1), three = estimate(2, {}, 3);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->noise.sigma_px, three->noise.sigma_px);
  EXPECT_EQ(one->noise.sigma_m, three->noise.sigma_m);
}

TEST_F(DepthNoiseByPoses, leaves_a_stated_noise_alone) {
  SurveyOptions options;
  options.observer.depth_noise.stated.sigma_px = 0.1;
  EXPECT_FALSE(estimate(1, options));
}

}  // namespace
}  // namespace cairn
