// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/trajectory_file.h"

#include <gtest/gtest.h>

#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

class TrajectoryFileTest : public testing::Test, protected RecordingFolder {};

TEST_F(TrajectoryFileTest, every_format_is_recognised) {
  struct Case {
    const char *text, *format;
    PoseKey key;
    std::int64_t first_key;
    double x;
    bool is_of_body;
  };
  const Case cases[] = {
      {"0.5 7 0 0 0 0 0 1\n", "TUM", PoseKey::stamp, 500'000'000, 7, false},
      {"1 0 0 7 0 1 0 0 0 0 1 0\n", "KITTI", PoseKey::position, 0, 7, false},
      {"500000000,7,0,0,1,0,0,0\n", "EuRoC", PoseKey::stamp, 500'000'000, 7, true},
      {"frame,x,y,z,qx,qy,qz,qw\n3,7,0,0,0,0,0,1\n", "table", PoseKey::number, 3, 7, false},
      {"time,east,north,up,roll,pitch,heading\n0.5,7,0,0,0,0,0\n", "table", PoseKey::stamp, 500'000'000, 7,
       true},
      {"time,lat,lon,height,roll,pitch,heading\n0.5,49,8,100,0,0,0\n", "table", PoseKey::stamp, 500'000'000,
       0, true},
  };
  for (const Case& each : cases) {
    const TrajectoryFile file = read_trajectory_file(write("poses.txt", each.text));
    EXPECT_EQ(file.format, each.format) << each.text;
    EXPECT_EQ(file.key, each.key) << each.text;
    EXPECT_EQ(file.is_of_body, each.is_of_body) << each.text;
    ASSERT_EQ(file.poses.size(), 1U);
    EXPECT_EQ(file.poses[0].stamp_ns, each.first_key) << each.text;
    EXPECT_NEAR(file.poses[0].world_from_camera.translation.x(), each.x, 1e-9) << each.text;
  }
}

TEST_F(TrajectoryFileTest, geodetic_poses_become_metres_about_the_origin) {
  const auto path =
      write("t.csv", "time,lat,lon,height,roll,pitch,heading\n0,49,8,100,0,0,0\n1,49,8,103,0,0,0\n");
  const TrajectoryFile own = read_trajectory_file(path);
  EXPECT_EQ(own.origin, (GeodeticOrigin{49, 8, 100}));
  EXPECT_NEAR(own.poses[1].world_from_camera.translation.z(), 3, 1e-6);
  TrajectoryFileOptions options;
  options.origin = GeodeticOrigin{49, 8, 90};
  EXPECT_NEAR(read_trajectory_file(path, options).poses[1].world_from_camera.translation.z(), 13, 1e-6);
}

TEST_F(TrajectoryFileTest, the_first_row_counts_though_it_has_no_fix) {
  const TrajectoryFile file = read_trajectory_file(
      write("t.csv", "time,lat,lon,height,roll,pitch,heading\n5,0,0,0,0,0,0\n6,49,8,103,0,0,0\n"));
  EXPECT_EQ(file.first_key, 5'000'000'000);
  EXPECT_EQ(file.poses[0].stamp_ns, 6'000'000'000);
  EXPECT_EQ(file.warnings.size(), 1U);
}

TEST_F(TrajectoryFileTest, whole_numbers_are_frames_where_they_may_be) {
  const auto path = write("p.txt", "3 7 0 0 0 0 0 1\n5 8 0 0 0 0 0 1\n");
  EXPECT_EQ(read_trajectory_file(path).poses[1].stamp_ns, 5'000'000'000);
  EXPECT_EQ(read_trajectory_file(path, {.may_have_numbers = true}).key, PoseKey::number);
  EXPECT_EQ(read_trajectory_file(path, {.may_have_numbers = true}).poses[1].stamp_ns, 5);
}

TEST_F(TrajectoryFileTest, poses_without_time_get_that_of_the_frames) {
  TrajectoryFile kitti =
      read_trajectory_file(write("k.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 8 0 1 0 0 0 0 1 0\n"));
  stamp_by_frames("k.txt", {10, 11}, {100, 250}, kitti);
  EXPECT_EQ(kitti.key, PoseKey::stamp);
  EXPECT_EQ(kitti.poses[1].stamp_ns, 250);
  TrajectoryFile numbers =
      read_trajectory_file(write("n.txt", "9 7 0 0 0 0 0 1\n11 8 0 0 0 0 0 1\n"), {.may_have_numbers = true});
  stamp_by_frames("n.txt", {10, 11}, {100, 250}, numbers);
  ASSERT_EQ(numbers.poses.size(), 1U);
  EXPECT_EQ(numbers.poses[0].stamp_ns, 250);
  TrajectoryFile few = read_trajectory_file(write("k.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n"));
  EXPECT_EQ(
      message_of([&] {
        return stamp_by_frames("k.txt", {10, 11}, {100, 250}, few), 0;
      }),
      "k.txt: expected 2 poses, one for each frame, found 1.\n  Add or delete lines, or give the poses with "
      "time stamps (TUM format).");
}

}  // namespace
}  // namespace cairn
