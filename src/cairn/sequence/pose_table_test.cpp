// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/sequence/listed_frames.h"

namespace cairn {
namespace {

using testkit::earth_centred;
using testkit::earth_from_enu;
using testkit::forward_camera_on_frd;
using testkit::message_of;
using testkit::RecordingFolder;
using testkit::sequence_of;

constexpr double kDegree = std::numbers::pi / 180;

class PoseTableTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] GivenPoses read(const std::string& text, const char* format = "TUM") const {
    Sequence sequence = sequence_of(format, {0, 1, 2}, 10);
    sequence.calibration.body_from_camera = forward_camera_on_frd();
    GivenPosesOptions options;
    options.path = write("table.csv", text);
    return read_given_poses(sequence, options);
  }
  static Rigid3 body(const GivenPoses& poses, std::size_t i) {
    return poses.frames.at(i)->world_from_camera * forward_camera_on_frd().inverse();
  }
};

TEST_F(PoseTableTest, heading_is_clockwise_from_north) {
  const GivenPoses poses = read(
      "time_s,east_m,north_m,up_m,roll_deg,pitch_deg,heading_deg\n"
      "0,10,20,30,0,0,0\n0.1,10,20,30,0,0,90\n0.2,10,20,30,0,0,180\n");
  EXPECT_EQ(poses.format, "table");
  EXPECT_FALSE(poses.origin);
  EXPECT_FALSE(poses.frames[0]->uncertainty);
  // the camera sits 2 m ahead, 0.5 m right, 1 m up and looks ahead
  const Eigen::Vector3d centres[] = {{10.5, 22, 31}, {12, 19.5, 31}, {9.5, 18, 31}};
  const Eigen::Vector3d aheads[] = {{0, 1, 0}, {1, 0, 0}, {0, -1, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    const WorldFromCamera& pose = poses.frames[i]->world_from_camera;
    EXPECT_LT((pose.translation - centres[i]).norm(), 1e-12);
    EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitZ() - aheads[i]).norm(), 1e-12);
    EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);  // down
  }
}

TEST_F(PoseTableTest, roll_lowers_the_right_side_and_pitch_lifts_the_front) {
  const GivenPoses poses =
      read("time_s,east,north,up,roll,pitch,heading\n0,0,0,0,10,0,0\n0.1,0,0,0,0,10,0\n0.2,0,0,0,0,0,0\n");
  const Eigen::Vector3d right = poses.frames[0]->world_from_camera.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(right.z(), -std::sin(10 * kDegree), 1e-12);
  const Eigen::Vector3d ahead = poses.frames[1]->world_from_camera.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(ahead.z(), std::sin(10 * kDegree), 1e-12);
}

/// Against the closed formulas through the earth's centre.
TEST_F(PoseTableTest, geodetic_places_become_east_north_up) {
  const GivenPoses poses = read(
      "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n"
      "0,-33.5,151.25,40,0,0,0\n0.1,-33.4,151.5,90,1,-2,300\n");
  ASSERT_TRUE(poses.origin);
  EXPECT_EQ(poses.origin->latitude_deg, -33.5);
  EXPECT_EQ(poses.origin->height_m, 40);
  EXPECT_EQ(poses.without_pose, 1U);
  const Eigen::Matrix3d world_from_earth = earth_from_enu(-33.5, 151.25).transpose();
  const Eigen::Vector3d place =
      world_from_earth * (earth_centred(-33.4, 151.5, 90) - earth_centred(-33.5, 151.25, 40));
  EXPECT_LT((body(poses, 1).translation - place).norm(), 1e-6);
  Eigen::Matrix3d enu_from_ned;
  enu_from_ned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  const auto about = [](double angle_deg, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_deg * kDegree, axis).toRotationMatrix();
  };
  const Eigen::Matrix3d ned_from_body = about(300, Eigen::Vector3d::UnitZ()) *
                                        about(-2, Eigen::Vector3d::UnitY()) *
                                        about(1, Eigen::Vector3d::UnitX());
  const Eigen::Matrix3d expected =
      world_from_earth * earth_from_enu(-33.4, 151.5) * enu_from_ned * ned_from_body;
  EXPECT_LT((body(poses, 1).matrix3() - expected).norm(), 1e-9);
}

TEST_F(PoseTableTest, names_units_and_order_of_the_columns_are_free) {
  const GivenPoses expected =
      read("time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n0.1,49,8,100,1,2,3\n");
  for (const char* text :
       {"# Heading [deg], pitch (deg), Roll, HEIGHT (m), Lon, Lat, Time [s], satellites, v_north\n"
        "3, 2, 1, 100, 8, 49, 0.1, 12, fast\n",
        "\xEF\xBB\xBF\n\nlat,lon,height,roll,pitch,heading,time_ns\r\n# "
        "noise\r\n49,8,100,1,2,3,100000000\r\n",
        "time,latitude,longitude,height,roll,pitch,heading_rad\n0.1,49,8,100,1,2,0.052359877559829883\n"}) {
    const GivenPoses found = read(text);
    ASSERT_TRUE(found.frames[1]) << text;
    EXPECT_LT(
        left_perturbation(found.frames[1]->world_from_camera, expected.frames[1]->world_from_camera).norm(),
        1e-12);
    EXPECT_EQ(found.origin->longitude_deg, 8);
  }
}

TEST_F(PoseTableTest, rows_may_belong_to_frames_by_number) {
  const GivenPoses poses =
      read("frame,east,north,up,roll,pitch,heading\n1,5,0,0,0,0,0\n7,6,0,0,0,0,0\n", "KITTI");
  EXPECT_EQ(poses.without_pose, 2U);
  EXPECT_NEAR(body(poses, 1).translation.x(), 5, 1e-12);
}

struct BrokenTable {
  std::string text;
  int line;
  const char *expected, *found, *remedy;
};

void expect_refused(const BrokenTable& broken, const std::string& message, const std::string& path) {
  const std::string place = broken.line > 0 ? path + ":" + std::to_string(broken.line) : path;
  EXPECT_TRUE(message.starts_with(place + ": expected " + broken.expected)) << message;
  EXPECT_NE(message.find(std::string(", found ") + broken.found + ".\n  " + broken.remedy), std::string::npos)
      << message;
}

TEST_F(PoseTableTest, broken_headers_are_refused) {
  const char* const names = "names of columns as in docs/poses.md";
  const char* const add = "Add or rename columns (docs/poses.md).";
  const BrokenTable cases[] = {
      {"time,lat,lon,height,roll,pitch\n", 1, "'heading' among the columns: time (s, ns) or frame; latitude",
       "time, lat, lon, height, roll, pitch", add},
      {"\ntime,lat,height,roll,pitch,heading\n", 2, "'longitude' among",
       "time, lat, height, roll, pitch, heading", add},
      {"lat,lon,height,roll,pitch,heading\n", 1, "'time' or 'frame' among",
       "lat, lon, height, roll, pitch, heading", add},
      {"time,roll,pitch,heading\n", 1, "'latitude', 'longitude', 'height' or 'east', 'north', 'up' among",
       "time, roll, pitch, heading", add},
      {"time,frame,east,north,up,roll,pitch,heading\n", 1, "either 'time' or 'frame'", "both",
       "Delete or rename"},
      {"time,lat,lon,height,east,north,up,roll,pitch,heading\n", 1, "either 'latitude'", "both",
       "Delete or rename"},
      {"time,lat,latitude,lon,height,roll,pitch,heading\n", 1, "one column 'latitude'",
       "'lat' and 'latitude'", "Delete one."},
      {"time_s,time_ns,east,north,up,roll,pitch,heading\n", 1, "one column 'time'", "'time_s' and 'time_ns'",
       "Delete one."},
      {"time,lattitude,lon,height,roll,pitch,heading\n", 1, names, "'lattitude'", "Did you mean 'latitude'?"},
      {"time,east,north,up,roll,pitch,heading,rms_north\n", 1, names, "'rms_north'",
       "Did you mean 'std_north'?"},
      {"time,east,north,up,roll,pitch,heading,sigma_n\n", 1, names, "'sigma_n'", "Did you mean"},
      {"time,east,north,up,roll,pitch,heading (gon)\n", 1, "'heading' in deg or rad", "'heading (gon)'",
       "Convert the column"},
      {"time_min,east,north,up,roll,pitch,heading\n", 1, "'time' or 'frame' among",
       "time_min, east, north, up, roll, pitch, heading", add},
      {"time (min),east,north,up,roll,pitch,heading\n", 1, "'time' in s or ms or us or ns", "'time (min)'",
       "Convert"},
      {"frame (s),east,north,up,roll,pitch,heading\n", 1, "'frame' in no unit", "'frame (s)'", "Convert"},
      {"time,east,north,up,roll,pitch,heading,std_north\n", 1, "'std_east' among",
       "time, east, north, up, roll, pitch, heading, std_north", add},
      {"time,east,north,up,roll,pitch,heading,std_roll,std_pitch\n", 1, "'std_heading' among",
       "time, east, north, up, roll, pitch, heading, std_roll, std_pitch", add},
      {"a,b,c\n1,2,3\n", 1, "'time' or 'frame' among", "a, b, c", add},
      {"time,east,north,up,roll,pitch,heading\n", 0, "poses, one a line, below the names of the columns",
       "none", "Check that this is the right file."},
  };
  for (const BrokenTable& broken : cases)
    expect_refused(broken, message_of([&] { return read(broken.text); }), (folder_ / "table.csv").string());
}

TEST_F(PoseTableTest, broken_rows_are_refused) {
  const std::string local = "time_s,east,north,up,roll,pitch,heading,std_east,std_north,std_up\n";
  const std::string geodetic = "time_ns,lat,lon,height,roll,pitch,heading\n";
  const char *const correct = "Correct or delete the line.",
                    *const names = "Correct the names of the columns, or the line.",
                    *const units = "Check the order and the units of the columns.";
  const BrokenTable cases[] = {
      {local + "0,1,2,3\n", 2, "10 values (time_s, east, north", "4", names},
      {local + "x,1,2,3,4,5,6,7,8,9\n", 2, "a time stamp in seconds", "'x'", correct},
      {local + "0,1,2,up,4,5,6,7,8,9\n", 2, "a number for up", "'up'", correct},
      {local + "0,1,2,3,4,5,6,7,nan,9\n", 2, "a number for std_north", "'nan'", correct},
      {local + "0,1e13,0,0,0,0,0,0,0,0\n", 2, "east from -1e+12 to 1e+12 m", "1e+13", units},
      {local + "0,0,0,0,0,91,0,0,0,0\n", 2, "pitch from -90 to 90 degrees", "91", units},
      {local + "0,0,0,0,0,0,361,0,0,0\n", 2, "heading from -360 to 360 degrees", "361", units},
      {local + "0,0,0,0,0,0,0,0,-1,0\n", 2, "std_north from 0 to 1e+06 m", "-1", units},
      {local + "1,0,0,0,0,0,0,0,0,0\n\n0.5,0,0,0,0,0,0,0,0,0\n", 4, "a time stamp after 1.000000000",
       "0.500000000", "Sort the file by time."},
      {geodetic + "0.5,0,0,0,0,0,0\n", 2, "a time stamp in whole nanoseconds", "'0.5'", correct},
      {geodetic + "5,4900,8,0,0,0,0\n", 2, "latitude from -90 to 90 degrees", "4900", units},
      {geodetic + "5,49,361,0,0,0,0\n", 2, "longitude from -180 to 360 degrees", "361", units},
      {"frame,east,north,up,roll,pitch,heading\n0.5,0,0,0,0,0,0\n", 2, "a whole number for frame", "'0.5'",
       correct},
      {"frame,east,north,up,roll,pitch,heading\n2,0,0,0,0,0,0\n1,0,0,0,0,0,0\n", 3, "a frame number after 2",
       "1", "Sort the file by number."},
  };
  for (const BrokenTable& broken : cases)
    expect_refused(broken, message_of([&] { return read(broken.text); }), (folder_ / "table.csv").string());
}

}  // namespace
}  // namespace cairn
