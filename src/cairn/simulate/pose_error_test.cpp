// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/core/file.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/simulate/write_kitti.h"
#include "cairn/simulate/write_tum.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

PoseErrorOptions gnss() {
  PoseErrorOptions options;
  options.position_std = 0.05;
  options.rotation_std_deg = 0.2;
  options.correlation_time_s = 4;
  return options;
}

/// Returns the standard deviations that the options state, radians.
Vector6d stated(const PoseErrorOptions& options) {
  Vector6d deviations;
  deviations << Eigen::Vector3d::Constant(options.total_position_std()),
      Eigen::Vector3d::Constant(kDegree * options.total_rotation_std_deg());
  return deviations;
}

/// The variance of n normal numbers has a relative standard deviation of sqrt(2 / n).
TEST(PoseError, has_the_stated_deviation_from_the_first_pose_on) {
  constexpr int kSeeds = 4000;
  PoseErrorOptions options = gnss();
  options.jitter_position_std = 0.03;
  options.jitter_rotation_std_deg = 0.1;
  const std::int64_t stamps[] = {0, 2'000'000'000};
  Vector6d first = Vector6d::Zero(), second = Vector6d::Zero();
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto errors = draw_pose_errors(options, stamps, seed);
    first += errors[0].cwiseAbs2() / kSeeds;
    second += errors[1].cwiseAbs2() / kSeeds;
  }
  const Vector6d expected = stated(options).cwiseAbs2();
  for (const Vector6d& variances : {first, second})
    EXPECT_LT((variances.cwiseQuotient(expected).array() - 1).abs().maxCoeff(), 5 * std::sqrt(2.0 / kSeeds));
}

/// What of an error is not exp(-dt / T) times the one before is new: it has the rest of the variance and is
/// independent, over gaps of any length.
TEST(PoseError, wanders_as_a_gauss_markov_process) {
  constexpr int kCount = 20'000;
  const PoseErrorOptions options = gnss();
  std::vector<std::int64_t> stamps{0};
  for (int i = 1; i < kCount; ++i)
    stamps.push_back(stamps.back() + (i % 5 == 0 ? 3'000'000'000 : 200'000'000));
  const auto errors = draw_pose_errors(options, stamps, 11);
  Vector6d squares = Vector6d::Zero(), with_last = Vector6d::Zero();
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const double kept = std::exp(-1e-9 * static_cast<double>(stamps[i] - stamps[i - 1]) / 4);
    const Vector6d scale = stated(options), last = errors[i - 1].cwiseQuotient(scale);
    const Vector6d added = (errors[i].cwiseQuotient(scale) - kept * last) / std::sqrt(1 - kept * kept);
    squares += added.cwiseAbs2() / (kCount - 1);
    with_last += added.cwiseProduct(last) / (kCount - 1);
  }
  EXPECT_LT((squares.array() - 1).abs().maxCoeff(), 5 * std::sqrt(2.0 / kCount));
  EXPECT_LT(with_last.cwiseAbs().maxCoeff(), 5 / std::sqrt(1.0 * kCount));
}

TEST(PoseError, jitter_is_new_in_each_pose) {
  constexpr int kCount = 20'000;
  PoseErrorOptions options;
  options.jitter_position_std = 0.02;
  options.jitter_rotation_std_deg = 0.1;
  std::vector<std::int64_t> stamps(kCount);
  for (int i = 0; i < kCount; ++i) stamps[static_cast<std::size_t>(i)] = i * 1'000'000LL;
  const auto errors = draw_pose_errors(options, stamps, 5);
  Vector6d products = Vector6d::Zero();
  for (std::size_t i = 1; i < errors.size(); ++i)
    products += errors[i].cwiseProduct(errors[i - 1]).cwiseQuotient(stated(options).cwiseAbs2()) / kCount;
  EXPECT_LT(products.cwiseAbs().maxCoeff(), 5 / std::sqrt(1.0 * kCount));
}

TEST(PoseError, depends_on_seed_and_stamps_alone) {
  const std::int64_t stamps[] = {0, 100'000'000, 250'000'000};
  const auto all = draw_pose_errors(gnss(), stamps, 3), begin = draw_pose_errors(gnss(), {stamps, 2}, 3),
             other = draw_pose_errors(gnss(), stamps, 4);
  EXPECT_EQ(begin[1], all[1]);
  EXPECT_NE(other[1], all[1]);
}

/// Expects that the options are refused with this message.
void expect_refused(const PoseErrorOptions& options, const char* message) {
  EXPECT_EQ(testkit::message_of([&] { return options.validate(); }), message);
}

TEST(PoseError, wrong_options_are_named) {
  PoseErrorOptions negative, turned, still;
  negative.position_std = -0.1;
  turned.jitter_rotation_std_deg = 11;
  still.correlation_time_s = 0;
  expect_refused(negative,
                 "--pose-error: expected metres from 0 to 100, found -0.1.\n  Choose another value.");
  expect_refused(turned, "--pose-jitter: expected degrees from 0 to 10, found 11.\n  Choose another value.");
  expect_refused(
      still, "--pose-error-time: expected seconds from 0.001 to 100000, found 0.\n  Choose another value.");
}

SimulateStreetOptions tiny_street() {
  SimulateStreetOptions options;
  options.camera = resized(options.camera, 0.05);
  options.frames_count = 8;
  options.pose_error = gnss();
  return options;
}

class WrittenPoseErrorTest : public testing::Test {
 protected:
  /// Expects that the table holds the drawn poses of the camera and what they state.
  void expect_read_back(const char* name, const StampedPoses& drawn) const {
    const Sequence sequence = open_sequence(folder_);
    GivenPosesOptions options;
    options.path = folder_ / name;
    const GivenPoses given = read_given_poses(sequence, options);
    ASSERT_EQ(given.without_pose, 0U);
    const Vector6d variances = stated(gnss()).cwiseAbs2();
    for (std::size_t i = 0; i < given.frames.size(); ++i) {
      const GivenPose& pose = *given.frames[i];
      EXPECT_LT(motion_norm(pose.world_from_camera.inverse() * drawn[i].second), 1e-8);
      EXPECT_GT(motion_norm(pose.world_from_camera.inverse() * (*sequence.truth)[i].world_from_camera), 1e-3);
      ASSERT_TRUE(pose.uncertainty);
      EXPECT_LT((pose.uncertainty->position.diagonal() - variances.head<3>()).norm(), 1e-12);
      EXPECT_LT((pose.uncertainty->rotation.diagonal() - variances.tail<3>()).norm(), 1e-15);
    }
  }

  const testkit::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  Progress silent_;
};

TEST_F(WrittenPoseErrorTest, street_states_it_and_keeps_the_truth) {
  SimulateStreetOptions options = tiny_street();
  const SimulatedStreet street(options);
  write_kitti(street, folder_, false, Executor(2), silent_);
  expect_read_back("given_poses.txt", street.given_poses());
  const auto erroneous = testkit::contents_of(folder_);
  options.pose_error = {};
  std::filesystem::remove(folder_ / "given_poses.txt");
  write_kitti(SimulatedStreet(options), folder_, false, Executor(1), silent_);
  auto exact = testkit::contents_of(folder_);
  exact["given_poses.txt"] = erroneous.at("given_poses.txt");
  EXPECT_TRUE(exact == erroneous);  // to the last byte
}

TEST_F(WrittenPoseErrorTest, body_poses_have_it_in_a_table_of_their_own) {
  SimulateStreetOptions options = tiny_street();
  options.body_poses.emplace().rate_hz = options.rate_hz;
  const SimulatedStreet street(options);
  write_kitti(street, folder_, false, Executor(), silent_);
  const Sequence sequence = open_sequence(folder_);
  GivenPosesOptions given;
  given.path = folder_ / "given_body_poses.csv";
  const Rigid3 camera = camera_poses(read_given_poses(sequence, given))[5].value();
  const Rigid3 body = street.given_poses()[5].second;
  EXPECT_LT(motion_norm(camera.inverse() * body * SimulatedStreet::stated_body_from_camera()), 1e-8);
}

TEST_F(WrittenPoseErrorTest, room_states_it) {
  SimulateRoomOptions options;
  options.camera = resized(options.camera, 0.05);
  options.frames_count = 5;
  options.pose_error = gnss();
  const SimulatedRoom room(options);
  write_tum(room, folder_, Executor(2), silent_);
  expect_read_back("given_poses.txt", room.given_poses());
}

}  // namespace
}  // namespace cairn
