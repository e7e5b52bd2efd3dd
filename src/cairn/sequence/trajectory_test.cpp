// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/trajectory.h"

#include <gtest/gtest.h>

#include "cairn/core/random.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

class TrajectoryTest : public testing::Test, protected RecordingFolder {};

TEST_F(TrajectoryTest, reads_stamps_translations_and_quaternions) {
  const Trajectory read = read_tum_trajectory(
      write("poses.txt",
            "# a comment\n\n1305031453.359684 1 -2.5 3e-1 0 0 0.7071 0.7071\n1305031454 0 0 0 0 0 0 1"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].stamp_ns, 1'305'031'453'359'684'000);
  EXPECT_EQ(read[0].world_from_camera.translation, Eigen::Vector3d(1, -2.5, 0.3));
  EXPECT_NEAR(read[0].world_from_camera.rotation.norm(), 1, 1e-15);
  const Eigen::Vector3d turned = read[0].world_from_camera.rotation * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((turned - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);  // a quarter turn about z: qx qy qz qw
}

TEST_F(TrajectoryTest, line_ends_marks_and_blanks_of_other_systems_do_not_matter) {
  const Trajectory read = read_tum_trajectory(write(
      "poses.txt", "\xEF\xBB\xBF# from Windows\r\n1 0 0 0 0 0 0 1 \r\n\r\n  2\t0 0 0  0 0 0 1 # last\r\n"));
  EXPECT_EQ(read.size(), 2U);
}

/// As the benchmark's own groundtruth.txt of freiburg2 has them.
TEST_F(TrajectoryTest, a_stamp_that_comes_twice_counts_once) {
  const Trajectory read = read_tum_trajectory(
      write("poses.txt", "1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 5 0 0 0 0 0 1\n2 6 0 0 0 0 0 1\n"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].world_from_camera.translation.x(), 5);
}

TEST_F(TrajectoryTest, round_trip) {
  Random random(3);
  Trajectory written;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    const Eigen::Vector3d place(random.normal(), 1e4 * random.normal(), random.normal());
    written.push_back({1'305'031'453'359'684'123 + i, WorldFromCamera({rotation_exp(axis), place})});
  }
  const Trajectory read = read_tum_trajectory(write("poses.txt", format_tum_trajectory(written)));
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp_ns, written[i].stamp_ns);
    const Rigid3 moved = read[i].world_from_camera.inverse() * written[i].world_from_camera;
    EXPECT_LT(motion_norm(moved), 1e-8);
  }
}

TEST_F(TrajectoryTest, broken_lines_are_refused_by_number) {
  struct Case {
    const char* text;
    const char* place;
    const char* expected;
    const char* found;
    const char* remedy;
  };
  const char* const mend = "Correct or delete the line.";
  const char* const sort = "Sort the file by time.";
  const char* const order = "Check the order of the columns: t tx ty tz qx qy qz qw.";
  const Case cases[] = {
      {"", "", "poses, one a line: t tx ty tz qx qy qz qw", "none", "Check that this is the right file."},
      {"# only this\n", "", "poses, one a line: t tx ty tz qx qy qz qw", "none",
       "Check that this is the right file."},
      {"1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n", ":2", "8 values (t tx ty tz qx qy qz qw)", "7", mend},
      {"1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1 9\n", ":2", "8 values (t tx ty tz qx qy qz qw)", "9", mend},
      {"x 0 0 0 0 0 0 1\n", ":1", "a time stamp in seconds", "'x'", mend},
      {"nan 0 0 0 0 0 0 1\n", ":1", "a time stamp in seconds", "'nan'", mend},
      {"1e99 0 0 0 0 0 0 1\n", ":1", "a time stamp in seconds", "'1e99'", mend},
      {"1 0 nan 0 0 0 0 1\n", ":1", "a number for ty", "'nan'", mend},
      {"1 0 0 0 0 0 0 inf\n", ":1", "a number for qw", "'inf'", mend},
      {"1 0 0 0x 0 0 0 1\n", ":1", "a number for tz", "'0x'", mend},
      {"1 0 0 0 0 0 0 0\n", ":1", "a quaternion of length 1", "one of length 0", order},
      {"1 0 0 0 0 0 0 2\n", ":1", "a quaternion of length 1", "one of length 2", order},
      {"2 0 0 0 0 0 0 1\n\n1.5 0 0 0 0 0 0 1\n", ":3", "a time stamp after 2.000000000", "1.500000000", sort},
  };
  for (const Case& broken : cases) {
    const auto path = write("poses.txt", broken.text);
    EXPECT_EQ(message_of([&] { return read_tum_trajectory(path); }),
              path.string() + broken.place + ": expected " + broken.expected + ", found " + broken.found +
                  ".\n  " + broken.remedy);
  }
}

}  // namespace
}  // namespace cairn
