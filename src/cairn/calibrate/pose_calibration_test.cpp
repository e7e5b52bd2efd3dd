// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/pose_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/testing/calibrate/body_drive.h"

namespace cairn {
namespace {

using testkit::BodyDrive;

const PoseTerms kPlanted = (PoseTerms() << 0.0035, -0.0035, 0.0035, 0.1, -0.1, 0.1, 0.005, 0.02).finished();

BodyDrive noisy_drive() {
  BodyDrive drive;
  drive.place_noise = 0.003;
  drive.angle_noise = 0.0001;
  return drive;
}

PoseCalibration calibrate(const BodyDrive& drive, const PoseCalibrationOptions& options = {}) {
  return calibrate_poses(drive.visual(), drive.given(), options);
}

Finding finding(const PoseCalibration& found, int term) {
  return found.findings[static_cast<std::size_t>(term)];
}

TEST(CalibratePoses, what_was_planted_is_off_and_corrected) {
  BodyDrive drive = noisy_drive();
  drive.planted = kPlanted;
  const PoseCalibration found = calibrate(drive);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(finding(found, i), Finding::off) << i << ' ' << found.why[static_cast<std::size_t>(i)];
    EXPECT_LT(std::abs(found.value[i] - kPlanted[i]), 4 * found.sigma[i]) << i;
  }
  const Rigid3 corrected = found.corrected(BodyDrive::stated());
  EXPECT_LT(
      (corrected.translation - BodyDrive::stated().translation - kPlanted.segment<3>(lever_arm_term)).norm(),
      0.05);
  EXPECT_NEAR(found.scale_factor(), 1.005, 0.0015);
}

TEST(CalibratePoses, nothing_is_off_where_nothing_was_planted) {
  for (int seed = 1; seed <= 10; ++seed) {
    BodyDrive drive = noisy_drive();
    drive.seed = static_cast<std::uint64_t>(seed);
    const PoseCalibration found = calibrate(drive);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(finding(found, i), Finding::as_stated) << seed << ' ' << i;
  }
}

TEST(CalibratePoses, a_level_drive_does_not_show_the_height_of_the_camera) {
  BodyDrive drive = noisy_drive();
  drive.tilts = false;
  drive.planted = kPlanted;
  const PoseCalibration found = calibrate(drive);
  EXPECT_EQ(finding(found, lever_arm_term + 2), Finding::undetermined);
  for (const int term : {0, 1, 2, 3, 4, 6, 7}) EXPECT_EQ(finding(found, term), Finding::off) << term;
  EXPECT_EQ(found.corrected(BodyDrive::stated()).translation.z(), BodyDrive::stated().translation.z());
}

TEST(CalibratePoses, a_straight_drive_shows_the_scale_and_where_the_camera_looks) {
  BodyDrive drive = noisy_drive();
  drive.turns = false;
  drive.planted = kPlanted;
  const PoseCalibration found = calibrate(drive);
  for (const int term : {0, 3, 4, 5, 7}) {
    EXPECT_EQ(finding(found, term), Finding::undetermined) << term;
    EXPECT_FALSE(found.why[static_cast<std::size_t>(term)].empty()) << term;
  }
  for (const int term : {1, 2, 6}) EXPECT_EQ(finding(found, term), Finding::off) << term;
}

TEST(CalibratePoses, what_disparities_leave_open_makes_the_scale_uncertain) {
  PoseCalibrationOptions options;
  options.scale_sigma = 0.01;
  const PoseCalibration found = calibrate(noisy_drive(), options);
  EXPECT_EQ(finding(found, scale_term), Finding::undetermined);
  EXPECT_GE(found.sigma[scale_term], 0.01);
}

TEST(CalibratePoses, halves_that_differ_make_a_term_uncertain) {
  BodyDrive drive = noisy_drive();
  Trajectory visual = drive.visual();
  const Eigen::Vector3d middle = visual[100].world_from_camera.translation;
  for (std::size_t i = 101; i < visual.size(); ++i) {  // the second half is 2 % longer
    auto& place = visual[i].world_from_camera.translation;
    place = middle + 1.02 * (place - middle);
  }
  const PoseCalibration found = calibrate_poses(visual, drive.given(), {});
  EXPECT_EQ(finding(found, scale_term), Finding::undetermined);
}

TEST(CalibratePoses, without_times_there_is_no_time_offset) {
  PoseCalibrationOptions options;
  options.has_times = false;
  const PoseCalibration found = calibrate(noisy_drive(), options);
  EXPECT_EQ(finding(found, time_term), Finding::undetermined);
  EXPECT_EQ(found.why[time_term], "the recording has no times");
  EXPECT_GE(found.sigma[time_term], 0.1);
  EXPECT_EQ(finding(found, scale_term), Finding::as_stated);
}

TEST(CalibratePoses, poses_of_another_drive_determine_nothing) {
  BodyDrive drive = noisy_drive(), other = noisy_drive();
  other.turns = false;
  const PoseCalibration found = calibrate_poses(drive.visual(), other.given(), {});
  for (int i = 0; i < 8; ++i) EXPECT_EQ(finding(found, i), Finding::undetermined) << i;
}

TEST(CalibratePoses, a_standing_camera_and_a_short_drive_determine_nothing) {
  BodyDrive brief = noisy_drive();
  brief.duration_s = 2;
  Trajectory standing;
  for (int i = 0; i < 100; ++i) standing.push_back({100'000'000LL * i, WorldFromCamera()});
  GivenPath still = noisy_drive().given();
  std::vector<SubjectPose> poses = still.path.poses();
  for (SubjectPose& pose : poses) pose.world_from_subject = {};
  still.path = PosePath(poses, 0.15);
  for (const PoseCalibration& found : {calibrate(brief), calibrate_poses(standing, still, {})}) {
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(finding(found, i), Finding::undetermined) << i;
      EXPECT_FALSE(found.why[static_cast<std::size_t>(i)].empty()) << i;
    }
  }
}

TEST(QuantitiesOf, have_units_that_people_think_in) {
  PoseCalibration found;
  found.value = kPlanted;
  const std::vector<Quantity> quantities = quantities_of(found, "baseline factor");
  ASSERT_EQ(quantities.size(), 8U);
  EXPECT_EQ(quantities[0].name, "baseline factor");
  EXPECT_DOUBLE_EQ(quantities[0].value, 1.005);
  EXPECT_EQ(quantities[1].unit, "s");
  EXPECT_NEAR(quantities[2].value, 0.2005, 1e-4);
  EXPECT_EQ(quantities[2].name, "boresight x");
  EXPECT_EQ(quantities[7].name, "lever arm z");
  EXPECT_DOUBLE_EQ(quantities[7].value, 0.1);
}

}  // namespace
}  // namespace cairn
