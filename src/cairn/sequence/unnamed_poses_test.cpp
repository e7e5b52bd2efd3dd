// SPDX-License-Identifier: Apache-2.0
// One path in the words of several programs: each gives the poses of the plain TUM file.
#include <gtest/gtest.h>

#include <string>

#include "cairn/sequence/trajectory_file.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

constexpr const char* kPlain = "10.5 1 2 3 0 0 0.6 0.8\n11.5 4 5 6 0.6 0 0 0.8\n";

class UnnamedPosesTest : public testing::Test, protected RecordingFolder {
 protected:
  [[nodiscard]] TrajectoryFile read(const std::string& text, bool may_have_numbers = false) const {
    return read_trajectory_file(write("poses.txt", text), {.may_have_numbers = may_have_numbers});
  }
  void expect_plain(const std::string& text) const { expect_poses(read(text), read(kPlain).poses, text); }
  static void expect_poses(const TrajectoryFile& file, const Trajectory& plain, const std::string& text) {
    ASSERT_EQ(file.poses.size(), plain.size()) << text;
    EXPECT_FALSE(file.is_of_body) << text;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const WorldFromCamera& a = file.poses[i].world_from_camera;
      const WorldFromCamera& b = plain[i].world_from_camera;
      EXPECT_EQ(file.poses[i].stamp_ns, plain[i].stamp_ns) << text;
      EXPECT_LT((a.translation - b.translation).norm(), 1e-6) << text;
      EXPECT_LT(a.rotation.angularDistance(b.rotation), 1e-6) << text;
    }
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    const auto path = write("poses.txt", text);
    return message_of([&] { return read_trajectory_file(path); }).substr(path.string().size());
  }
};

TEST_F(UnnamedPosesTest, rows_of_tum_with_any_separator_more_columns_or_a_head) {
  for (const char* text :
       {"10.5,1,2,3,0,0,0.6,0.8\n11.5,4,5,6,0.6,0,0,0.8\n",
        "10.5; 1; 2; 3; 0; 0; 0.6; 0.8\n11.5;4;5;6;0.6;0;0;0.8\n",
        "\xEF\xBB\xBF\x31\x30.5\t1\t2\t3\t0\t0\t0.6\t0.8\r\n11.5\t4\t5\t6\t0.6\t0\t0\t0.8\r\n",
        "10.5 1 2 3 0 0 0.6 0.8 17\n11.5 4 5 6 0.6 0 0 0.8 18\n",
        "10.5 1 2 3 0 0 0.6 0.8 0.1 0.2 0.3 7\n11.5 4 5 6 0.6 0 0 0.8 0.1 0.2 0.3 8\n",
        "10500000000 1 2 3 0 0 0.6 0.8\n11500000000 4 5 6 0.6 0 0 0.8\n",
        "Trajectory exported on Monday\n10.5 1 2 3 0 0 0.6 0.8\n11.5 4 5 6 0.6 0 0 0.8\n",
        "timestamp;tx;ty;tz;qx;qy;qz;qw\n10.5;1;2;3;0;0;0.6;0.8\n11.5;4;5;6;0.6;0;0;0.8\n"})
    expect_plain(text);
}

TEST_F(UnnamedPosesTest, between_commas_the_order_that_is_assumed_is_said) {
  const TrajectoryFile file = read("10.5,1,2,3,0,0,0.6,0.8\n");
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_TRUE(file.warnings[0].ends_with(": no line names its columns: taken as t tx ty tz qx qy qz qw."));
  EXPECT_TRUE(read(kPlain).warnings.empty());
}

TEST_F(UnnamedPosesTest, matrices_with_and_without_stamps_numbers_and_a_last_row) {
  const std::string first = "0.28 -0.96 0 1 0.96 0.28 0 2 0 0 1 3",
                    second = "1 0 0 4 0 0.28 -0.96 5 0 0.96 0.28 6";
  const std::string last = " 0 0 0 1";
  expect_plain("10.5 " + first + "\n11.5 " + second + "\n");
  expect_plain("10.5 " + first + last + "\n11.5 " + second + last + "\n");
  Trajectory plain = read(kPlain).poses;
  const auto number = [&](std::int64_t from) {
    for (StampedPose& pose : plain) pose.stamp_ns = from++;
  };
  number(0);
  expect_poses(read(first + "\n" + second + "\n"), plain, "3x4");
  expect_poses(read(first + last + "\n" + second + last + "\n"), plain, "4x4");
  EXPECT_EQ(read(first + last + "\n").key, PoseKey::position);
  number(7);
  const TrajectoryFile numbered = read("7 " + first + "\n8 " + second + "\n");
  EXPECT_EQ(numbered.key, PoseKey::number);
  expect_poses(numbered, plain, "number and 3x4");
}

TEST_F(UnnamedPosesTest, vertices_of_a_graph_by_their_ids) {
  Trajectory plain = read(kPlain).poses;
  plain[0].stamp_ns = 3;
  plain[1].stamp_ns = 12;
  const TrajectoryFile graph = read(
      "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 12 4 5 6 0.6 0 0 0.8\nVERTEX_SE3:QUAT 3 1 2 3 0 0 "
      "0.6 0.8\n"
      "FIX 3\nEDGE_SE3:QUAT 3 12 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  EXPECT_EQ(graph.format, "g2o");
  EXPECT_EQ(graph.key, PoseKey::number);
  expect_poses(graph, plain, "g2o");
  const TrajectoryFile planar = read("VERTEX_SE2 0 1 2 1.5707963267948966\n");
  EXPECT_LT((planar.poses[0].world_from_camera * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 0)).norm(),
            1e-9);
  EXPECT_NE(refusal("VERTEX_SE2 0 1 2 0\nVERTEX_SE2 0 1 2 0\n").find("vertex 0 a second time"),
            std::string::npos);
}

TEST_F(UnnamedPosesTest, a_file_of_another_kind_is_named_as_a_whole) {
  EXPECT_EQ(refusal("1 2 3\n4 5 6\n7 8 9\n"),
            ": expected poses: 8 values a line, t tx ty tz qx qy qz qw (TUM), 12 of a 3x4 matrix (KITTI), or "
            "a first "
            "line that names the columns, found 3 values in each of 3 lines.\n  Name the columns in a first "
            "line such "
            "as time,x,y,z,qx,qy,qz,qw (docs/poses.md), or name another file.");
  EXPECT_NE(refusal("once upon\na time\n").find("none of which begins with a number"), std::string::npos);
  EXPECT_EQ(refusal("\x89PNG\r\n\x1a\n and so on"),
            ": expected a text file, found a picture (PNG).\n  Name the text file instead.");
  const std::string wide(
      "\xFF\xFE"
      "1\0 \0002\0\n\0",
      10);
  EXPECT_NE(refusal(wide).find("found text in UTF-16.\n  Save it as UTF-8: iconv"), std::string::npos);
  EXPECT_NE(refusal("-1 0 0 0 0 1 0 0 0 0 1 0\n").find("a matrix that mirrors"), std::string::npos);
  EXPECT_NE(refusal("5 -1 0 0 0 0 1 0 0 0 0 1 0\n").find("a matrix that mirrors"), std::string::npos);
}

}  // namespace
}  // namespace cairn
