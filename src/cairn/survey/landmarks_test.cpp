// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/landmarks.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "cairn/core/executor.h"
#include "cairn/core/random.h"
#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

TEST(AdjustTracks, says_what_became_of_each) {
  const auto points = testkit::roadside_points(6);
  FrameBuffer frames = testkit::drive(points, 8, 0.2);
  frames[KeyframeId{3}].observed.observations[2].u += 40;  // one observation of a good track
  for (int i = 0; i < 8; ++i) {                            // a track that jumps to and fro
    Observation& seen = frames[KeyframeId{i}].observed.observations[4];
    seen.u += i % 2 == 0 ? 30.0 * i : -45.0 * i;
    seen.v += 20.0 * (i % 3) * i;
  }
  std::vector<Track> tracks;
  for (std::int32_t i = 0; i < 6; ++i) tracks.push_back(testkit::track_of(frames, i, 0, i == 1 ? 1 : 7));
  const AdjustedTracks adjusted = adjust_tracks(kDriveRig, frames, tracks, {}, Executor());
  EXPECT_EQ(adjusted.too_short, 1);
  EXPECT_EQ(adjusted.inconsistent, 1);
  EXPECT_EQ(adjusted.dropped_observations, 1);
  ASSERT_EQ(adjusted.landmarks.size(), 4U);
  for (const auto& [landmark, point] : {std::pair{0, 0}, {1, 2}, {2, 3}, {3, 5}}) {
    const SurveyLandmark& found = adjusted.landmarks[static_cast<std::size_t>(landmark)];
    EXPECT_EQ(found.observations.front().feature, point);
    EXPECT_EQ(found.observations.size(), point == 2 ? 7U : 8U);
    EXPECT_EQ(found.indicators.frames, static_cast<int>(found.observations.size()));
    EXPECT_EQ(found.redundancy, 3 * static_cast<int>(found.observations.size()) - 3);
    EXPECT_LT(found.squared_error_sum, 30);
    const Eigen::Vector3d error = found.point_in_world - points[static_cast<std::size_t>(point)].position;
    EXPECT_LT(error.dot(found.cofactor.inverse() * error), 9);
  }
}

TEST(AdjustTracks, is_the_same_at_any_number_of_threads) {
  const FrameBuffer frames = testkit::drive(testkit::roadside_points(300), 14, 0.5);
  std::vector<Track> tracks;
  for (std::int32_t i = 0; i < 300; ++i) tracks.push_back(testkit::track_of(frames, i, i % 5, 6 + i % 8));
  const auto adjust = [&](int threads) {
    return adjust_tracks(kDriveRig, frames, tracks, {}, Executor(threads)).landmarks;
  };
  const auto one = adjust(1);
  EXPECT_GT(one.size(), 250U);
  for (const int threads : {2, 3}) {
    const auto many = adjust(threads);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].point_in_world, one[i].point_in_world);
      EXPECT_EQ(many[i].cofactor, one[i].cofactor);
      EXPECT_EQ(many[i].observations, one[i].observations);
    }
  }
}

TEST(FitObservations, is_what_adjust_tracks_makes_of_them) {
  const FrameBuffer frames = testkit::drive(testkit::roadside_points(1), 9, 0.5);
  const std::vector<Track> tracks{testkit::track_of(frames, 0, 1, 8)};
  const AdjustedTracks adjusted = adjust_tracks(kDriveRig, frames, tracks, {}, Executor());
  const auto fitted = fit_observations(kDriveRig, frames, tracks[0].observations, {});
  ASSERT_TRUE(fitted.has_value());
  ASSERT_EQ(adjusted.landmarks.size(), 1U);
  EXPECT_EQ(fitted->point_in_world, adjusted.landmarks[0].point_in_world);
  EXPECT_FALSE(fit_observations(kDriveRig, frames, testkit::observations_of(0, 0, 1), {}).has_value());
}

/// Positive definite, none of its entries zero: of (c, w), metres and radians.
Matrix6d joint_covariance() {
  Matrix6d half;
  Random random(4);
  for (Eigen::Index i = 0; i < 36; ++i) half.data()[i] = random.uniform(-1, 1);
  Vector6d sizes;
  sizes << 0.1, 0.1, 0.1, 0.004, 0.004, 0.004;
  return sizes.asDiagonal() * (half * half.transpose() + 0.1 * Matrix6d::Identity()) * sizes.asDiagonal();
}

PoseUncertainty uncertainty_of(const Matrix6d& joint) {
  return {joint.topLeftCorner<3, 3>(), joint.bottomRightCorner<3, 3>(), joint.topRightCorner<3, 3>()};
}

class PoseErrors : public testing::Test {
 protected:
  PoseErrors() {
    landmark_.observations = testkit::observations_of(0, 0, 5);
    landmark_.point_in_world = points_[0].position;
    landmark_.redundancy = 15;
    landmark_.squared_error_sum = 20;
    landmark_.information.pixels = Eigen::Vector3d(1, 0.5, 0.25).asDiagonal();
    landmark_.information.errors.pixel_errors = 20;
    landmark_.information.errors.pixel_redundancy = 15;
    landmark_.information.errors.observations = 6;
  }
  void be_uncertain(int first, int last) {
    for (int i = first; i <= last; ++i)
      frames_[KeyframeId{i}].given.uncertainty = uncertainty_of(joint_covariance());
  }

  std::vector<testkit::DrivePoint> points_ = testkit::roadside_points(1);
  FrameBuffer frames_ = testkit::drive(points_, 6);
  SurveyLandmark landmark_;
};

TEST_F(PoseErrors, move_landmarks_as_simulated) {
  be_uncertain(0, 5);
  complete_covariance(frames_, {}, true, landmark_);
  const Eigen::LLT<Matrix6d> root(joint_covariance());
  Random random(8);
  Eigen::Matrix3d simulated = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 40'000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Vector6d normal;
    for (double& value : normal) value = random.normal();
    const Vector6d error = root.matrixL() * normal;  // (c, w)
    for (const SurveyFrame& frame : frames_.all()) {
      // The camera saw the point where it is; the pose that was given says where it lies.
      const Rigid3& given = frame.given.world_from_camera;
      const Rigid3 truth{rotation_exp(error.tail<3>()) * given.rotation, given.translation + error.head<3>()};
      const Eigen::Vector3d moved = truth * (given.inverse() * landmark_.point_in_world);
      const Eigen::Vector3d by = moved - landmark_.point_in_world;
      simulated += by * by.transpose() / (6.0 * kDraws);
    }
  }
  EXPECT_LT((landmark_.pose_covariance - simulated).norm(), 0.03 * simulated.norm());
  PoseUncertainty apart = uncertainty_of(joint_covariance());  // the cross term matters here
  apart.position_rotation.setZero();
  for (int i = 0; i < 6; ++i) frames_[KeyframeId{i}].given.uncertainty = apart;
  complete_covariance(frames_, {}, true, landmark_);
  EXPECT_GT((landmark_.pose_covariance - simulated).norm(), 0.1 * simulated.norm());
}

TEST_F(PoseErrors, do_not_shrink_with_the_number_of_frames) {
  PoseUncertainty position;
  position.position = Eigen::Vector3d(0.01, 0.02, 0.03).asDiagonal();
  for (int i = 0; i < 6; ++i) frames_[KeyframeId{i}].given.uncertainty = position;
  complete_covariance(frames_, {}, true, landmark_);
  EXPECT_LT((landmark_.pose_covariance - position.position).norm(), 1e-15);
}

TEST_F(PoseErrors, add_nothing_where_none_are_given) {
  complete_covariance(frames_, {}, true, landmark_);
  EXPECT_EQ(landmark_.pose_covariance, Eigen::Matrix3d::Zero());
  EXPECT_EQ(landmark_.variance_factor, VariancePrior().factor(20, 15));
}

TEST_F(PoseErrors, add_nothing_where_they_are_not_wanted) {
  be_uncertain(0, 5);
  complete_covariance(frames_, {}, false, landmark_);
  EXPECT_EQ(landmark_.pose_covariance, Eigen::Matrix3d::Zero());
}

TEST_F(PoseErrors, join_the_covariance) {
  be_uncertain(0, 5);
  complete_covariance(frames_, {}, true, landmark_);
  const double factor = VariancePrior().factor(20, 15);
  const Eigen::Matrix3d by_images = Eigen::Vector3d(factor, 2 * factor, 4 * factor).asDiagonal();
  EXPECT_LT((landmark_.image_covariance - by_images).norm(), 1e-12);
  EXPECT_EQ(landmark_.covariance(), landmark_.image_covariance + landmark_.pose_covariance);
}

}  // namespace
}  // namespace cairn
