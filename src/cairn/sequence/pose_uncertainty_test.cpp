// SPDX-License-Identifier: Apache-2.0
// The covariances of given poses against what happens to the poses when the numbers in the table err.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cairn/core/random.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::earth_centred;
using testkit::RecordingFolder;
using testkit::sequence_of;

constexpr int kSamples = 20'000;

class PoseUncertaintyTest : public testing::Test, protected RecordingFolder {
 protected:
  /// One row per frame at 1 Hz: numbers, then the same standard deviations in all.
  [[nodiscard]] GivenPoses read(const std::string& places, const std::string& rows, std::size_t count) const {
    std::vector<std::int64_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::int64_t>(i);
    Sequence sequence = sequence_of("TUM", numbers, 1);
    sequence.calibration.body_from_camera = Rigid3{rotation_exp({0.4, -1.1, 0.7}), {1.5, -0.8, -2.0}};
    GivenPosesOptions options;
    options.path = write("table.csv", "time_s," + places +
                                          ",roll,pitch,heading,std_east,std_north,std_up,std_roll,"
                                          "std_pitch,std_heading\n" +
                                          rows);
    return read_given_poses(sequence, options);
  }
};

/// E[(c, w) (c, w)^T] as the struct has it.
Matrix6d joint(const PoseUncertainty& uncertainty) {
  Matrix6d covariance;
  covariance << uncertainty.position, uncertainty.position_rotation,
      uncertainty.position_rotation.transpose(), uncertainty.rotation;
  return covariance;
}

/// The errors of place and angles, drawn with these standard deviations, arrive at the camera with the stated
/// covariance: through the angles' own axes, the lever arm, and the turn from the place's axes to the
/// origin's (50 degrees of longitude away, where east points elsewhere).
TEST_F(PoseUncertaintyTest, is_what_errors_in_the_table_do) {
  const std::array<double, 6> deviations{0.02, 0.05, 0.11, 0.1, 0.2, 0.4};
  const std::string stated = "0.02,0.05,0.11,0.1,0.2,0.4";
  const double latitude = 47, longitude = 58;
  const Eigen::Vector3d nominal = earth_centred(latitude, longitude, 300);
  const double metre_north = (earth_centred(latitude + 1e-5, longitude, 300) - nominal).norm() / 1e-5;
  const double metre_east = (earth_centred(latitude, longitude + 1e-5, 300) - nominal).norm() / 1e-5;
  Random random(7);
  std::string rows = fmt::format("0,47,8,0,0,0,0,{}\n1,47,58,300,12,-25,130,{}\n", stated, stated);
  for (int i = 0; i < kSamples; ++i) {
    std::array<double, 6> e{};
    for (std::size_t k = 0; k < 6; ++k) e.at(k) = deviations.at(k) * random.normal();
    rows += fmt::format("{},{:.12f},{:.12f},{:.9f},{:.9f},{:.9f},{:.9f},{}\n", i + 2,
                        latitude + e[1] / metre_north, longitude + e[0] / metre_east, 300 + e[2], 12 + e[3],
                        -25 + e[4], 130 + e[5], stated);
  }
  const GivenPoses poses = read("latitude,longitude,height", rows, kSamples + 2);
  const GivenPose& given = *poses.frames[1];
  Matrix6d sampled = Matrix6d::Zero();
  for (std::size_t i = 2; i < poses.frames.size(); ++i) {
    const WorldFromCamera& drawn = poses.frames[i]->world_from_camera;
    Vector6d error;
    error << drawn.translation - given.world_from_camera.translation,
        rotation_log(drawn.rotation * given.world_from_camera.rotation.conjugate());
    sampled += error * error.transpose() / kSamples;
  }
  const Matrix6d expected = joint(given.uncertainty.value());
  const Vector6d sigma = expected.diagonal().cwiseSqrt();
  const Matrix6d difference =
      sigma.cwiseInverse().asDiagonal() * (sampled - expected) * sigma.cwiseInverse().asDiagonal();
  // a sampled correlation has a standard deviation of at most sqrt(2 / n)
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 5 * std::sqrt(2.0 / kSamples));
  EXPECT_GT(given.uncertainty->position_rotation.norm(), 1e-6);  // the lever arm ties them
}

TEST_F(PoseUncertaintyTest, by_hand_for_a_level_body_that_heads_north) {
  const GivenPoses poses = read("east,north,up", "0,0,0,0,0,0,0,0.1,0.2,0.3,1,2,3\n", 1);
  const PoseUncertainty& uncertainty = poses.frames[0]->uncertainty.value();
  const double degree2 = std::pow(std::numbers::pi / 180, 2);
  // roll turns about north, pitch about east, heading about up
  const Eigen::Vector3d turns = degree2 * Eigen::Vector3d(4, 1, 9);
  EXPECT_LT((uncertainty.rotation - Eigen::Matrix3d(turns.asDiagonal())).norm(), 1e-15);
  // the arm lies 1.5 north, 0.8 west, 2 up; east errs by heading over 1.5 m and by roll over 2 m
  EXPECT_NEAR(uncertainty.position(0, 0), 0.01 + degree2 * (9 * 2.25 + 1 * 4), 1e-12);
  EXPECT_NEAR(uncertainty.position(1, 1), 0.04 + degree2 * (9 * 0.64 + 4 * 4), 1e-12);
  EXPECT_NEAR(uncertainty.position(2, 2), 0.09 + degree2 * (4 * 2.25 + 1 * 0.64), 1e-12);
}

TEST_F(PoseUncertaintyTest, at_the_end_of_the_angles_range_the_axes_are_those_of_the_derivative) {
  const Attitude attitude{0.3, -1.2, 2.5};
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    Attitude moved = attitude;
    (i == 0 ? moved.roll : i == 1 ? moved.pitch : moved.yaw) += kStep;
    const Eigen::Vector3d turn = rotation_log(rotation_of(moved) * rotation_of(attitude).conjugate()) / kStep;
    EXPECT_LT((turn - turn_by_angles(attitude).col(i)).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace cairn
