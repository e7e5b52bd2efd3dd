// SPDX-License-Identifier: Apache-2.0
// What real files of poses hold beside poses: stamps that come twice, rows before the receiver had a fix,
// jumps, another clock.
#include <gtest/gtest.h>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::forward_camera_on_frd;
using testkit::message_of;
using testkit::RecordingFolder;
using testkit::sequence_of;

namespace fs = std::filesystem;

using Texts = std::vector<std::string>;

class PoseOdditiesTest : public testing::Test, protected RecordingFolder {
 protected:
  PoseOdditiesTest() { sequence_.calibration.body_from_camera = forward_camera_on_frd(); }
  [[nodiscard]] GivenPoses read(const fs::path& path, GivenPosesOptions options = {}) const {
    options.path = path;
    return read_given_poses(sequence_, options);
  }
  [[nodiscard]] Rigid3 body(const GivenPoses& poses, std::size_t i) const {
    return poses.frames.at(i).value().world_from_camera * forward_camera_on_frd().inverse();
  }
  Sequence sequence_ = sequence_of("TUM", {0, 1, 2}, 10);
};

TEST_F(PoseOdditiesTest, equal_rows_at_a_stamp_count_once) {
  const char* const files[] = {
      "0.1 1 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 -1\n0.2 2 0 0 0 0 0 1\n",
      ("#timestamp [ns],p_RS_R_x,p_RS_R_y,p_RS_R_z,q_RS_w,q_RS_x,q_RS_y,q_RS_z\n100000000,1,0,0,1,0,0,0\n"
       "100000000,1,0,0,1,0,0,0\n"),
      "100000000,1,0,0,1,0,0,0\n100000000,1,0,0,1,0,0,0\n",
      "time,east,north,up,roll,pitch,heading\n0.1,1,0,0,0,0,0\n0.1,1,0,0,0,0,0\n",
  };
  for (const char* text : files) {
    const GivenPoses poses = read(write("poses.txt", text));
    EXPECT_EQ(poses.warnings, Texts{}) << text;
    EXPECT_TRUE(poses.frames[1]) << text;
  }
}

TEST_F(PoseOdditiesTest, of_unequal_rows_at_a_stamp_the_first_counts_and_the_others_are_named) {
  const fs::path path =
      write("poses.txt", "0.1 1 0 0 0 0 0 1\n\n0.1 1.5 0 0 0 0 0 1\n0.1 9 0 0 0 0 0 1\n0.2 2 0 0 0 0 0 1\n");
  const GivenPoses poses = read(path);
  EXPECT_EQ(poses.frames[1]->world_from_camera.translation.x(), 1);
  EXPECT_EQ(poses.warnings,
            Texts{path.string() + ":3: a second pose, 0.5 m away, at 0.100000000; 2 such lines left "
                                  "out, the first pose counts."});
  const fs::path table =
      write("t.csv", "time,east,north,up,roll,pitch,heading\n0.1,1,0,0,0,0,0\n0.1,1,0,0,0,0,9\n");
  EXPECT_EQ(read(table).warnings,
            Texts{table.string() + ":3: a second pose, 0 m away, at 0.100000000; 1 such line "
                                   "left out, the first pose counts."});
}

TEST_F(PoseOdditiesTest, a_stamp_that_goes_backwards_is_refused) {
  const fs::path path =
      write("t.csv", "time,east,north,up,roll,pitch,heading\n0.1,1,0,0,0,0,0\n0.05,1,0,0,0,0,0\n");
  EXPECT_EQ(message_of([&] { return read(path); }),
            path.string() +
                ":3: expected a time stamp after 0.100000000, found 0.050000000.\n  Sort the file by time.");
}

constexpr const char* kGeodeticNames = "time,latitude,longitude,height,roll,pitch,heading\n";

TEST_F(PoseOdditiesTest, rows_before_a_fix_are_left_out) {
  const fs::path path =
      write("t.csv", std::string(kGeodeticNames) +
                         "0.0,0,0,0,0,0,0\n0.05,,,,,,\n0.1,49,8,100,0,0,0\n0.15,nan,nan,nan,0,0,0\n"
                         "0.2,49,8,101,0,0,0\n");
  const GivenPoses poses = read(path);
  ASSERT_TRUE(poses.origin);
  EXPECT_EQ(*poses.origin, (GeodeticOrigin{49, 8, 100}));
  EXPECT_FALSE(poses.frames[0]);
  EXPECT_LT(body(poses, 1).translation.norm(), 1e-9);
  EXPECT_EQ(poses.warnings,
            Texts{path.string() + ":2: 3 of 5 rows left out, from 0.000000000 on: no position (0 north "
                                  "and 0 east, empty or no number)."});
}

TEST_F(PoseOdditiesTest, without_any_fix_there_are_no_poses) {
  const fs::path path = write("t.csv", std::string(kGeodeticNames) + "0.0,0,0,0,0,0,0\n0.1,0,0,0,0,0,0\n");
  EXPECT_EQ(message_of([&] { return read(path); }),
            path.string() +
                ": expected rows with a position, found 2 with no position (0 north and 0 east, empty or no "
                "number).\n  Record once the receiver has a fix, or correct the columns.");
}

TEST_F(PoseOdditiesTest, a_local_world_may_have_poses_at_its_origin) {
  const GivenPoses poses =
      read(write("t.csv", "time,east,north,up,roll,pitch,heading\n0.0,0,0,0,0,0,0\n0.1,nan,0,0,0,0,0\n"));
  EXPECT_LT(body(poses, 0).translation.norm(), 1e-12);
  EXPECT_EQ(poses.warnings.size(), 1U);
}

TEST_F(PoseOdditiesTest, packets_before_a_fix_are_left_out) {
  const auto packet = [](const char* place) {
    return std::string(place) + " 0 0 0 0 0 0 0 0 0 0 9.8 0 0 9.8 0 0 0 0 0 0 0.05 0.02 4 11 6 6 6\n";
  };
  put("oxts/timestamps.txt", "1970-01-01 00:00:00.0\n1970-01-01 00:00:00.1\n1970-01-01 00:00:00.2\n");
  put("oxts/data/0000000000.txt", packet("0 0 0"));
  put("oxts/data/0000000001.txt", packet("nan nan nan"));
  put("oxts/data/0000000002.txt", packet("49 8 100"));
  const GivenPoses poses = read(folder_ / "oxts");
  EXPECT_EQ(poses.without_pose, 2U);
  EXPECT_EQ(*poses.origin, (GeodeticOrigin{49, 8, 100}));
  ASSERT_EQ(poses.warnings.size(), 1U);
  EXPECT_TRUE(
      poses.warnings[0].starts_with((folder_ / "oxts/timestamps.txt:1: 2 of 3 rows left out").string()))
      << poses.warnings[0];
}

TEST_F(PoseOdditiesTest, jumps_that_no_vehicle_makes_are_named) {
  const fs::path path =
      write("t.csv", std::string(kGeodeticNames) +
                         "0.0,49,8,100,0,0,0\n0.1,49.0001,8,100,0,0,0\n0.2,49.0101,8,100,0,0,0\n"
                         "0.3,49.0001,8,100,0,0,0\n");
  const GivenPoses poses = read(path);
  ASSERT_EQ(poses.warnings.size(), 1U);
  EXPECT_EQ(poses.warnings[0].substr(0, poses.warnings[0].find(" by ")),
            path.string() + ":4: the position jumps");
  EXPECT_NE(poses.warnings[0].find(" m within 0.1 s, at 0.200000000, faster than any vehicle; 2 such jumps."),
            std::string::npos)
      << poses.warnings[0];
  const fs::path local = write("p.txt", "0 0 0 0 0 0 0 1\n0.1 20 0 0 0 0 0 1\n0.2 18 0 0 0 0 0 1\n");
  EXPECT_EQ(read(local).warnings,
            Texts{local.string() + ":2: the position jumps by 20 m within 0.1 s, at 0.100000000, "
                                   "faster than any vehicle; 1 such jump. Check the positions there."});
}

TEST_F(PoseOdditiesTest, jumps_between_frames_are_named_where_the_poses_have_no_times) {
  sequence_.format = "KITTI";
  const fs::path path =
      write("k.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n1 0 0 42 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(read(path).warnings,
            Texts{path.string() + ": frame 2: the position jumps by 40 m within 0.1 s, at "
                                  "0.200000000, faster than any vehicle; 1 such jump. Check the "
                                  "positions there."});
}

TEST_F(PoseOdditiesTest, a_fast_train_and_noise_at_a_high_rate_are_no_jumps) {
  EXPECT_EQ(read(write("p.txt", "0 0 0 0 0 0 0 1\n0.1 12 0 0 0 0 0 1\n0.1001 12.9 0 0 0 0 0 1\n")).warnings,
            Texts{});
}

TEST_F(PoseOdditiesTest, another_clock_is_named_with_the_offset_that_aligns_the_starts) {
  const fs::path path = write("p.txt", "1317042145.594 0 0 0 0 0 0 1\n1317042145.694 1 0 0 0 0 0 1\n");
  const std::string message = message_of([&] { return read(path); });
  EXPECT_NE(
      message.find("add --pose-offset -1317042145.594, or --pose-offset start, which align the first stamps"),
      std::string::npos)
      << message;
  GivenPosesOptions options;
  options.time_offset_s = -1000;  // the figure counts it
  EXPECT_NE(message_of([&] { return read(path, options); }).find("--pose-offset -1317042145.594, or"),
            std::string::npos);
  options.time_offset_s = -1317042145.594;
  EXPECT_EQ(read(path, options).without_pose, 1U);
}

TEST_F(PoseOdditiesTest, starts_are_aligned_by_themselves) {
  GivenPosesOptions options;
  options.align_first_stamps = true;
  const fs::path path = write("p.txt", "1317042145.594 5 0 0 0 0 0 1\n1317042145.694 6 0 0 0 0 0 1\n");
  const GivenPoses poses = read(path, options);
  EXPECT_EQ(poses.frames[0]->world_from_camera.translation.x(), 5);
  EXPECT_EQ(poses.frames[1]->world_from_camera.translation.x(), 6);
  EXPECT_NEAR(poses.time_offset_s, -1317042145.594, 1e-6);
  EXPECT_EQ(poses.warnings,
            Texts{path.string() + ": the first stamps are aligned by an offset of -1317042145.594 s."});
  // the first frame of the recording, not the first of those that were chosen
  sequence_.first_stamp_ns = 0;
  sequence_.frames.erase(sequence_.frames.begin());
  EXPECT_EQ(read(path, options).frames[0]->world_from_camera.translation.x(), 6);
  // and the first row, though it has no fix
  const fs::path table =
      write("t.csv", std::string(kGeodeticNames) + "50.0,0,0,0,0,0,0\n50.1,49,8,100,0,0,0\n");
  EXPECT_EQ(read(table, options).without_pose, 1U);
  EXPECT_TRUE(read(table, options).frames[0]);
}

TEST_F(PoseOdditiesTest, starts_of_frame_numbers_are_not_aligned) {
  sequence_.format = "KITTI";
  GivenPosesOptions options;
  options.align_first_stamps = true;
  EXPECT_EQ(message_of([&] { return read(write("p.txt", "1 0 0 0 0 0 0 1\n"), options); }),
            "time_offset_s: expected 0, as these poses belong to frames by their numbers, found start.\n  "
            "Leave it out.");
}

}  // namespace
}  // namespace cairn
