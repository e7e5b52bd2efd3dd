// SPDX-License-Identifier: Apache-2.0
// Files of poses whose columns are named: the names decide, whatever their order.
#include <gtest/gtest.h>

#include <numbers>

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

/// A rotation that every other order of its components turns into another one.
const Eigen::Quaterniond kRotation(0.8, 0.2, -0.4, 0.4);  // w x y z
const Rigid3 kPose{kRotation, {1, 2, 3}};

class PoseNamesTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] GivenPoses read(const std::string& text, const char* name = "poses.txt") const {
    GivenPosesOptions options;
    options.path = write(name, text);
    return read_given_poses(sequence_, options);
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    return message_of([&] { return read(text); });
  }
  void expect_pose(const std::string& text) const {
    const GivenPoses poses = read(text);
    ASSERT_TRUE(poses.frames[1]) << text;
    EXPECT_LT(left_perturbation(poses.frames[1]->world_from_camera, kPose).norm(), 1e-12) << text;
  }
  Sequence sequence_ = sequence_of("TUM", {0, 1, 2}, 10);
};

TEST_F(PoseNamesTest, columns_are_read_by_name_whatever_their_order) {
  for (const char* text : {
           "# frame_id, translation_x, translation_y, translation_z, quat_x, quat_y, quat_z, quat_w, scale, "
           "fusion_quality, "
           "v3\n100000000,1,2,3,0.2,-0.4,0.4,0.8,1,2,3\n200000000,1,2,3,0.2,-0.4,0.4,0.8,1,2,3\n",
           "timestamp,tx,ty,tz,qw,qx,qy,qz\n0.1,1,2,3,0.8,0.2,-0.4,0.4\n",
           "qz,qy,qx,qw,pz,py,px,time_ns\n0.4,-0.4,0.2,0.8,3,2,1,100000000\n",
           "# timestamp tx ty tz qx qy qz qw\n0.1 1 2 3 0.2 -0.4 0.4 0.8\n",
           "# timestamp tx ty tz qw qx qy qz\n0.1 1 2 3 0.8 0.2 -0.4 0.4\n",
           "timestamp x y z q_w q_x q_y q_z\n0.1 1 2 3 0.8 0.2 -0.4 0.4\n",
           "#t[s] pos_x [m] pos_y [m] pos_z [m] qw [] qx [] qy [] qz []\n0.1 1 2 3 0.8 0.2 -0.4 0.4\n",
           "# Format: timestamp tx ty tz qw qx qy qz\n# 3 poses\n0.1 1 2 3 0.8 0.2 -0.4 0.4\n",
           "# ground truth, in metres\r\n# t tx ty tz qx qy qz qw  (seconds, metres; world_from_camera)\r\n"
           "0.1 1 2 3 0.2 -0.4 0.4 0.8\r\n",
           "%time,field.header.seq,field.pose.position.x,field.pose.position.y,field.pose.position.z,"
           "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,"
           "field.pose.orientation.w\n100000000,7,1,2,3,0.2,-0.4,0.4,0.8\n200000000,8,1,2,3,0.2,-0.4,0.4,0."
           "8\n",
           "\xEF\xBB\xBFTimestamp (ms),X,Y,Z,RotX,RotY,RotZ,RotW\n100,1,2,3,0.2,-0.4,0.4,0.8\n",
           "#timestamp [us],position.x,position.y,position.z,orientation.w,orientation.x,orientation.y,"
           "orientation.z,velocity.x,velocity.y,velocity.z\n100000,1,2,3,0.8,0.2,-0.4,0.4,9,9,9\n",
       })
    expect_pose(text);
}

TEST_F(PoseNamesTest, covariances_behind_the_poses_may_be_there_or_not) {
  const std::string names = "# timestamp(s) tx ty tz qx qy qz qw Pr11 Pr12 Pr13 Pt11 Pt12 Pt13\n";
  expect_pose(names + "0.10000 1 2 3 0.2 -0.4 0.4 0.8\n");
  expect_pose(names + "0.10000 1 2 3 0.2 -0.4 0.4 0.8 9 9 9 9 9 9\n");
  EXPECT_EQ(
      refusal(names + "0.1 1 2 3 0.2 -0.4 0.4 0.8 9 9 9 9 9 9\n0.2 1 2 3 0.2 -0.4 0.4 0.8 9\n"),
      (folder_ / "poses.txt").string() +
          ":3: expected 14 values (timestamp(s), tx, ty, tz, qx, qy, qz, qw, Pr11, Pr12, Pr13, Pt11, Pt12, "
          "Pt13), found 9.\n  Correct or delete the line.");
}

/// They are along and about the axes of the world, whatever the pose.
TEST_F(PoseNamesTest, standard_deviations_beside_quaternions_are_read) {
  const std::string names = "# time_s x_m y_m z_m qx qy qz qw std_x_m std_y_m std_z_m";
  const std::string row = "\n0.1 1 2 3 0.2 -0.4 0.4 0.8 0.1 0.2 0.3";
  expect_pose(names + row + "\n");
  const PoseUncertainty place = read(names + row + "\n").frames[1]->uncertainty.value();
  EXPECT_LT((place.position.diagonal() - Eigen::Vector3d(0.01, 0.04, 0.09)).norm(), 1e-15);
  EXPECT_EQ(place.rotation, Eigen::Matrix3d::Zero());
  const PoseUncertainty both =
      read(names + " std_rx_rad std_ry_deg std_rz" + row + " 0.01 1 2\n").frames[1]->uncertainty.value();
  const Eigen::Vector3d angles(0.01, std::numbers::pi / 180, 2 * std::numbers::pi / 180);
  EXPECT_LT((both.rotation.diagonal() - angles.cwiseAbs2()).norm(), 1e-15);
  EXPECT_FALSE(read("time,x,y,z,qx,qy,qz,qw\n0.1,1,2,3,0.2,-0.4,0.4,0.8\n").frames[1]->uncertainty);
}

TEST_F(PoseNamesTest, euroc_poses_are_read_however_their_first_line_begins) {
  sequence_.calibration.body_from_camera.emplace();
  for (const char* text : {
           "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n",
           "timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n",
           "# Time_ns, px, py, pz, qw, qx, qy, qz\n",
           "#time(ns),px,py,pz,qw,qx,qy,qz\n",
           "# timestamp[ns],tx,ty,tz,qw,qx,qy,qz\n",
           "# poses of the body\n\n# stamp, position, quaternion (w x y z)\n",
           "timestamp,p,q\n",
           "#timestamp,p,q,v\n",
           "",
       })
    expect_pose(std::string(text) + "100000000,1,2,3,0.8,0.2,-0.4,0.4\n200000000,1,2,3,0.8,0.2,-0.4,0.4\n");
  EXPECT_EQ(read("100000000,1,2,3,0.8,0.2,-0.4,0.4\n").format, "EuRoC");
  EXPECT_TRUE(read("#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
                   "q_RS_z []\n100000000,1,2,3,0.8,0.2,-0.4,0.4\n")
                  .warnings.empty());
}

TEST_F(PoseNamesTest, stamps_in_nanoseconds_are_told_by_their_size) {
  sequence_ = sequence_of("TUM", {0, 1, 2}, 10);
  for (FrameFiles& files : sequence_.frames) files.stamp_ns += 1'403'636'579'663'555'584;
  expect_pose("1403636579763555584.000000 1 2 3 0.2 -0.4 0.4 0.8\n");
  expect_pose("# timestamp tx ty tz qx qy qz qw\n1403636579763555584 1 2 3 0.2 -0.4 0.4 0.8\n");
  expect_pose(
      "# frame_id, x, y, z, quat_x, quat_y, quat_z, quat_w\n1403636579763555584, 1,2,3,0.2,-0.4,0.4,0.8\n");
  expect_pose("timestamp,x,y,z,qx,qy,qz,qw\n1403636579763556,1,2,3,0.2,-0.4,0.4,0.8\n");
}

TEST_F(PoseNamesTest, named_frames_are_their_numbers) {
  sequence_ = sequence_of("KITTI", {4, 5, 6}, 7);
  expect_pose("frame,x,y,z,qx,qy,qz,qw\n5,1,2,3,0.2,-0.4,0.4,0.8\n");
  expect_pose("# frame_id, x, y, z, qx, qy, qz, qw\n5,1,2,3,0.2,-0.4,0.4,0.8\n");
  expect_pose("# frame tx ty tz qx qy qz qw\n5 1 2 3 0.2 -0.4 0.4 0.8\n");
}

/// Those of 4Seasons, say: of the body if it is known where the camera sits on it.
TEST_F(PoseNamesTest, whose_poses_a_table_holds_is_said_where_its_names_leave_it_open) {
  const std::string text =
      "frame_id,translation_x,translation_y,translation_z,quat_x,quat_y,quat_z,quat_w\n"
      "100000000,1,2,3,0.2,-0.4,0.4,0.8\n200000000,1,2,3,0.2,-0.4,0.4,0.8\n";
  const std::string path = (folder_ / "poses.txt").string();
  EXPECT_EQ(
      read(text).warnings,
      std::vector<std::string>{path + ": its columns do not say whose poses they are: taken as the camera's, "
                                      "as the calibration has no 'body: {body_from_camera: ...}'."});
  const Rigid3 body_from_camera{rotation_exp({0.1, 0.2, 0.3}), {1, 0, 2}};
  sequence_.calibration.body_from_camera = body_from_camera;
  const GivenPoses poses = read(text);
  EXPECT_EQ(poses.warnings,
            std::vector<std::string>{path +
                                     ": its columns do not say whose poses they are: taken as the body's, as "
                                     "the calibration has 'body: {body_from_camera: ...}'."});
  EXPECT_LT(left_perturbation(poses.frames[1]->world_from_camera, kPose * body_from_camera).norm(), 1e-12);
}

TEST_F(PoseNamesTest, a_sensor_file_beside_the_poses_says_what_was_tracked) {
  sequence_.calibration.body_from_camera.emplace();
  put("sensor.yaml", "T_BS:\n  data: [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n");
  const GivenPoses poses = read("t_ns,x,y,z,qx,qy,qz,qw\n100000000,1,2,3,0,0,0,1\n");
  EXPECT_LT((poses.frames[1]->world_from_camera.translation - Eigen::Vector3d(0.5, 2, 3)).norm(), 1e-12);
}

TEST_F(PoseNamesTest, names_that_leave_the_quaternion_open_are_refused) {
  const std::string path = (folder_ / "poses.txt").string();
  EXPECT_EQ(refusal("time,x,y,z,q0,q1,q2,q3\n0.1,1,2,3,1,0,0,0\n"),
            path +
                ":1: expected the quaternion's columns by the names qx, qy, qz, qw, found q0, q1, q2, q3.\n"
                "  Rename them: numbers do not say which one is the scalar part, qw.");
  struct Case {
    const char *names, *start;
  };
  const Case cases[] = {
      {"time,x,y,z,qx,qy,qz", "'qw' among the columns: "},
      {"# time x y z qx qy qz", "'qw' among the columns: "},
      {"time,x,y,qx,qy,qz,qw", "'z' among the columns: "},
      {"#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m]", "'qx' among the columns: "},
      {"x,y,z,qx,qy,qz,qw", "'time' or 'frame' among the columns: "},
      {"time,x,y,z,qx,qy,qz,qw,quat_w", "one column 'qw', found 'qw' and 'quat_w'.\n  Delete one."},
      {"time,x (km),y,z,qx,qy,qz,qw", "'x' in m, found 'x (km)'.\n  Convert the column"},
      {"time,x,y,z,qx,qy,qz,qw,std_x,std_y", "'std_z' among the columns: "},
      {"time,x,y,z,qx,qy,qz,qw,std_rz", "'std_rx' among the columns: "},
      {"time (min),x,y,z,qx,qy,qz,qw", "'time' in s or ms or us or ns, found 'time (min)'"},
  };
  for (const Case& broken : cases) {
    const std::string message = refusal(std::string(broken.names) + "\n1,2,3,4\n");
    EXPECT_TRUE(message.starts_with(path + ":1: expected " + broken.start)) << message;
  }
}

TEST_F(PoseNamesTest, rows_that_do_not_fit_the_names_are_refused) {
  const std::string names = "time,x,y,z,qx,qy,qz,qw\n", path = (folder_ / "poses.txt").string();
  EXPECT_EQ(refusal(names + "0.1,1,2,3,0,0,0,0.5\n"),
            path +
                ":2: expected a quaternion of length 1, found one of length 0.5.\n"
                "  Check the order of the columns: time, x, y, z, qx, qy, qz, qw.");
  EXPECT_EQ(refusal(names + "0.1,1,2,3,0,0,0\n"),
            path +
                ":2: expected 8 values (time, x, y, z, qx, qy, qz, qw), found 7.\n"
                "  Correct the names of the columns, or the line.");
  EXPECT_EQ(refusal(names + "0.1,1,2,3,0,0,0,1,5\n"),
            path +
                ":2: expected 8 values (time, x, y, z, qx, qy, qz, qw), found 9.\n"
                "  Correct the names of the columns, or the line.");
  EXPECT_EQ(refusal(names), path +
                                ": expected poses, one a line, below the names of the columns, found none.\n"
                                "  Check that this is the right file.");
  EXPECT_EQ(
      refusal("1326030975726043, 1, 2, 3, 0.1, 0.2, 0.3\n"),
      path +
          ":1: expected 8 values (stamp, px, py, pz, qw, qx, qy, qz, ...), or a first line that names the "
          "columns, found 7.\n  Add a line with the names of the columns (docs/poses.md).");
}

/// Local tables in other words, and NED.
TEST_F(PoseNamesTest, surveyors_names) {
  sequence_.calibration.body_from_camera = forward_camera_on_frd();
  const GivenPoses expected = read("time,east,north,up,roll,pitch,heading\n0.1,10,20,30,1,2,90\n");
  for (const char* text :
       {"Time (s),Easting (m),Northing (m),Height (m),Roll (deg),Pitch (deg),Azimuth "
        "(deg)\n0.1,10,20,30,1,2,90\n",
        "Job 17 by A. "
        "Surveyor\n\ntimestamp,easting,northing,elevation,roll,pitch,heading\n0.1,10,20,30,1,2,90\n",
        "# time north east down roll pitch heading\n0.1 20 10 -30 1 2 90\n",
        "utime_us,north,east,down,roll,pitch,heading\n100000,20,10,-30,1,2,90\n"}) {
    const GivenPoses found = read(text);
    ASSERT_TRUE(found.frames[1]) << text;
    EXPECT_LT(
        left_perturbation(found.frames[1]->world_from_camera, expected.frames[1]->world_from_camera).norm(),
        1e-12);
  }
}

}  // namespace
}  // namespace cairn
