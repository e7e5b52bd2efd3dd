// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/sequence/sequence.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::RecordingFolder;
using testkit::sequence_of;

/// Returns a pose of a smooth motion.
Rigid3 motion(double t) {
  return {rotation_exp({0.1 * t, std::sin(t), 0.2}), {std::cos(t), 3 * t * t, 1}};
}

PosePath path_of(const std::vector<double>& seconds, double max_gap_s) {
  std::vector<SubjectPose> poses;
  for (const double t : seconds) poses.push_back({std::llround(1e9 * t), motion(t)});
  return {poses, max_gap_s};
}

TEST(PosePath, follows_a_smooth_motion_between_its_poses) {
  const PosePath path = path_of({0, 0.1, 0.2, 0.3, 0.4, 0.5}, 0.15);
  for (const double t : {0.1, 0.13, 0.25, 0.38}) {
    const auto pose = path.at(std::llround(1e9 * t));
    ASSERT_TRUE(pose);
    EXPECT_LT(motion_norm(pose->inverse() * motion(t)), 1e-5) << t;
  }
  const auto at_the_end = path.at(450'000'000);  // a line: no pose after the next one
  ASSERT_TRUE(at_the_end);
  EXPECT_NEAR(at_the_end->translation.y(), (motion(0.4).translation.y() + motion(0.5).translation.y()) / 2,
              1e-9);
}

TEST(PosePath, an_offset_is_added_to_the_stamps_of_the_poses) {
  const PosePath path = path_of({0, 0.1, 0.2, 0.3, 0.4, 0.5}, 0.15);
  const auto later = path.at(300'000'000, 0.05);
  ASSERT_TRUE(later);
  EXPECT_LT(motion_norm(later->inverse() * motion(0.25)), 1e-5);
}

TEST(PosePath, gaps_have_no_poses_but_at_their_ends) {
  const PosePath path = path_of({0, 0.1, 0.4, 0.5}, 0.15);
  EXPECT_FALSE(path.at(200'000'000));
  EXPECT_FALSE(path.at(-10'000'000));
  EXPECT_FALSE(path.at(510'000'000));
  for (const std::int64_t stamp :
       {-500'000, 0, 100'000'000, 100'900'000, 399'100'000, 500'000'000, 500'500'000})
    EXPECT_TRUE(path.at(stamp)) << stamp;
  EXPECT_FALSE(PosePath().at(0));
}

class GivenPathTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] GivenPath read(const Sequence& sequence, const std::string& text, double offset_s = 0) {
    GivenPosesOptions options;
    options.path = write("poses.csv", text);
    options.time_offset_s = offset_s;
    return read_given_path(sequence, options);
  }
};

TEST_F(GivenPathTest, has_the_poses_of_the_camera_with_their_stamps) {
  const GivenPath given = read(sequence_of("TUM", {0, 1, 2}, 10),
                               "0.05 1 0 0 0 0 0 1\n0.15 2 0 0 0 0 0 1\n0.25 3 0 0 0 0 0 1\n", 0.01);
  EXPECT_FALSE(given.is_of_body);
  EXPECT_FALSE(given.is_by_frame);
  EXPECT_EQ(given.time_offset_s, 0.01);
  ASSERT_EQ(given.path.poses().size(), 3U);
  EXPECT_EQ(given.path.poses()[0].stamp_ns, 60'000'000);
  EXPECT_EQ(given.path.poses()[2].world_from_subject.translation.x(), 3);
}

TEST_F(GivenPathTest, poses_that_belong_to_frames_get_their_stamps) {
  Sequence sequence = sequence_of("KITTI", {0, 1, 2}, 10);
  sequence.listed = 3;
  const GivenPath given =
      read(sequence, "1 0 0 5 0 1 0 0 0 0 1 0\n1 0 0 6 0 1 0 0 0 0 1 0\n1 0 0 7 0 1 0 0 0 0 1 0\n");
  EXPECT_TRUE(given.is_by_frame);
  ASSERT_EQ(given.path.poses().size(), 3U);
  EXPECT_EQ(given.path.poses()[1].stamp_ns, sequence.frames[1].stamp_ns);
  EXPECT_EQ(given.path.poses()[1].world_from_subject.translation.x(), 6);
}

TEST_F(GivenPathTest, poses_of_a_body_stay_the_body_s) {
  Sequence sequence = sequence_of("KITTI", {0, 1, 2}, 10);
  sequence.calibration.body_from_camera = Rigid3{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {1, 2, 3}};
  const GivenPath given =
      read(sequence, "time_s,x,y,z,qx,qy,qz,qw\n0,1,0,0,0,0,0,1\n0.1,2,0,0,0,0,0,1\n0.2,3,0,0,0,0,0,1\n");
  EXPECT_TRUE(given.is_of_body);
  EXPECT_EQ(given.subject_from_camera.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(given.path.poses()[0].world_from_subject.translation.x(), 1);
}

TEST_F(GivenPathTest, the_truth_of_a_camera_on_a_body_becomes_the_body_s_again) {
  Sequence sequence = sequence_of("EuRoC", {0, 1, 2}, 10);
  const Rigid3 body_from_camera{rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}},
      body{rotation_exp({1, 0, 0}), {7, 8, 9}};
  sequence.calibration.body_from_camera = body_from_camera;
  sequence.truth = Trajectory{{0, WorldFromCamera(body * body_from_camera)}};
  const GivenPath given = read_given_path(sequence);
  EXPECT_TRUE(given.is_of_body);
  EXPECT_LT(motion_norm(given.path.poses()[0].world_from_subject.inverse() * body), 1e-12);
}

}  // namespace
}  // namespace cairn
