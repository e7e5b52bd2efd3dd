// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/pose_fit.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "cairn/testing/calibrate/body_drive.h"

namespace cairn {
namespace {

using testkit::BodyDrive;

const PoseTerms kPlanted = (PoseTerms() << 0.003, -0.002, 0.004, 0.1, -0.05, 0.08, 0.005, 0.02).finished();

PoseFit fit(const BodyDrive& drive, bool with_time = true) {
  const GivenPath given = drive.given();
  const std::vector<Stretch> stretches = cut_stretches(drive.visual());
  return fit_poses({stretches, given.path, given.subject_from_camera, with_time});
}

TEST(FitPoses, finds_what_was_planted) {
  BodyDrive drive;
  drive.planted = kPlanted;
  const PoseFit found = fit(drive);
  EXPECT_EQ(found.stretches, 20);
  const PoseTerms error = found.value - kPlanted;
  EXPECT_LT(error.segment<3>(boresight_term).norm(), 1e-5);
  EXPECT_LT(error.segment<3>(lever_arm_term).norm(), 1e-3);
  EXPECT_LT(std::abs(error[scale_term]), 1e-5);
  EXPECT_LT(std::abs(error[time_term]), 1e-5);
}

TEST(FitPoses, finds_a_large_time_offset) {
  BodyDrive drive;
  drive.planted[time_term] = -0.4;
  EXPECT_NEAR(fit(drive).value[time_term], -0.4, 1e-4);
}

TEST(FitPoses, noise_of_the_given_poses_does_not_hide_the_time_offset) {
  for (int seed = 1; seed <= 5; ++seed) {
    BodyDrive drive;
    drive.planted = kPlanted;
    drive.given_noise = 0.05;
    drive.seed = static_cast<std::uint64_t>(seed);
    EXPECT_NEAR(fit(drive).value[time_term], kPlanted[time_term], 0.003) << seed;
  }
}

TEST(FitPoses, leaves_the_time_alone_where_it_is_not_sought) {
  BodyDrive drive;
  drive.planted = kPlanted;
  drive.planted[time_term] = 0;
  const PoseFit found = fit(drive, false);
  EXPECT_LT(std::abs(found.value[time_term]), 1e-12);
  EXPECT_NEAR(found.value[scale_term], kPlanted[scale_term], 1e-5);
}

TEST(FitPoses, wrong_motions_have_little_weight) {
  BodyDrive drive;
  drive.planted = kPlanted;
  drive.place_noise = 0.005;
  drive.angle_noise = 0.0002;
  const GivenPath given = drive.given();
  std::vector<Stretch> stretches = cut_stretches(drive.visual());
  const PoseTerms before = fit_poses({stretches, given.path, given.subject_from_camera}).value;
  stretches[7].first_from_last.translation *= 3;
  const PoseFit found = fit_poses({stretches, given.path, given.subject_from_camera});
  EXPECT_LT(std::abs(found.value[scale_term] - before[scale_term]), 0.002);
}

/// Squared errors in units of their variances are 1 on average, over 40 drives with noise.
TEST(FitPoses, says_honestly_how_sure_it_is) {
  constexpr int kDrives = 40;
  PoseTerms squares = PoseTerms::Zero();
  for (int i = 0; i < kDrives; ++i) {
    BodyDrive drive;
    drive.planted = kPlanted;
    drive.place_noise = 0.01;
    drive.angle_noise = 0.0005;
    drive.seed = static_cast<std::uint64_t>(i);
    const PoseFit found = fit(drive);
    squares += (found.value - kPlanted).cwiseAbs2().cwiseQuotient(found.covariance.diagonal()) / kDrives;
  }
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_GT(squares[i], 0.4) << i;
    EXPECT_LT(squares[i], 2.0) << i;
  }
}

TEST(FitPoses, a_straight_drive_leaves_the_prior_of_what_it_does_not_show) {
  BodyDrive drive;
  drive.turns = false;
  drive.place_noise = 0.01;
  drive.angle_noise = 0.0005;
  const PoseTerms sigma = fit(drive).covariance.diagonal().cwiseSqrt();
  EXPECT_GT(sigma[boresight_term], 0.03);  // about the way
  EXPECT_LT(sigma[boresight_term + 1], 0.001);
  EXPECT_LT(sigma[boresight_term + 2], 0.001);
  for (int i = 0; i < 3; ++i) EXPECT_GT(sigma[lever_arm_term + i], 0.45);
  EXPECT_LT(sigma[scale_term], 0.002);
  EXPECT_GT(sigma[time_term], 0.095);
}

TEST(FitPoses, without_poses_there_is_only_the_prior) {
  BodyDrive drive;
  const std::vector<Stretch> stretches = cut_stretches(drive.visual());
  const PosePath nothing;
  const PoseFit found = fit_poses({stretches, nothing, BodyDrive::stated()});
  EXPECT_EQ(found.stretches, 0);
  EXPECT_TRUE(found.value.isZero(0));
  EXPECT_NEAR(found.covariance(lever_arm_term, lever_arm_term), 0.25, 1e-12);
}

}  // namespace
}  // namespace cairn
