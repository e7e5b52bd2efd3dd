// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

/// A quarter turn about z, then a shift.
constexpr const char* kPose = "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n";

class SevenScenesTest : public testing::Test, protected RecordingFolder {
 protected:
  SevenScenesTest() {
    put("camera.yaml", kSmallCamera);
    for (const char* number : {"000007", "000002", "000010"}) {
      put(name(number, "color.jpg"), "");
      put(name(number, "depth.png"), "");
      put(name(number, "pose.txt"), kPose);
    }
  }
  static std::string name(const std::string& number, const std::string& kind) {
    return "frame-" + number + "." + kind;
  }
  [[nodiscard]] std::string refusal() const {
    return message_of([&] { return open_sequence(folder_); });
  }
};

TEST_F(SevenScenesTest, lists_frames_by_number) {
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "7-Scenes");
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[0].number, 2);
  EXPECT_EQ(sequence.frames[1].color, folder_ / "frame-000007.color.jpg");
  EXPECT_EQ(sequence.frames[2].depth, folder_ / "frame-000010.depth.png");
  EXPECT_EQ(sequence.frames[2].stamp_ns, 333'333'333);
  EXPECT_EQ(sequence.report.associated, 3);
  ASSERT_EQ(sequence.truth->size(), 3U);
  EXPECT_EQ(sequence.truth->at(2).stamp_ns, 333'333'333);
  const Eigen::Vector3d point = sequence.truth->at(0).world_from_camera * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((point - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST_F(SevenScenesTest, the_rate_makes_the_stamps) {
  put("camera.yaml", kSmallCamera + std::string("rate_hz: 10\n"));
  EXPECT_EQ(open_sequence(folder_).frames[2].stamp_ns, 1'000'000'000);
}

TEST_F(SevenScenesTest, is_a_video_at_30_hz) {
  EXPECT_TRUE(open_sequence(folder_).has_times);
}

TEST_F(SevenScenesTest, files_of_other_kinds_do_not_matter) {
  for (const char* kind : {"color.png.bak", "depth.proj.png", "color.txt", "pose.txt~"})
    put(name("000002", kind), "");
  for (const char* other :
       {"frame-x.color.png", "frame--00001.color.png", "._frame-000002.color.png", "frame-"})
    put(other, "");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[0].color, folder_ / "frame-000002.color.jpg");
  EXPECT_EQ(sequence.frames[0].depth, folder_ / "frame-000002.depth.png");
}

TEST_F(SevenScenesTest, half_a_frame_is_none) {
  fs::remove(folder_ / name("000007", "depth.png"));
  fs::remove(folder_ / name("000010", "color.jpg"));
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.frames.size(), 1U);
  EXPECT_EQ(sequence.report.color_images, 2);
  EXPECT_EQ(sequence.report.depth_images, 2);
  EXPECT_EQ(sequence.report.associated, 1);
}

TEST_F(SevenScenesTest, lost_poses_are_left_out) {
  put(name("000002", "pose.txt"), "0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\n");
  put(name("000007", "pose.txt"), "-nan inf NaN -INF\n0 0 0 0\n0 0 0 0\n0 0 0 1\n");
  EXPECT_EQ(open_sequence(folder_).truth->size(), 1U);
  fs::remove(folder_ / name("000010", "pose.txt"));
  EXPECT_FALSE(open_sequence(folder_).truth);
}

TEST_F(SevenScenesTest, broken_poses_are_refused) {
  struct Case {
    const char* text;
    const char* rest;
  };
  const Case cases[] = {
      {"", ": expected 4 lines, a 4x4 matrix, found 0 lines.\n  Correct or delete the file."},
      {"1 0 0 0\n0 1 0 0\n0 0 1 0\n",
       ": expected 4 lines, a 4x4 matrix, found 3 lines.\n  Correct or delete the file."},
      {"1 0 0 0\n0 1 0\n0 0 1 0\n0 0 0 1\n",
       ":2: expected 4 values (a row of a 4x4 matrix), found 3.\n  Correct or delete the line."},
      {"1 0 0 0\n0 1 0 0\n0 0 one 0\n0 0 0 1\n",
       ":3: expected a number for the matrix, found 'one'.\n  Correct or delete the line."},
      {"2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n",
       ":1: expected a rotation in the first three rows and columns, found a matrix with determinant 8, 5.2 "
       "from "
       "orthogonal.\n  Check that it is world_from_camera, or delete the file."},
      {"-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
       ":1: expected a rotation in the first three rows and columns, found a matrix with determinant -1, 0 "
       "from "
       "orthogonal.\n  Check that it is world_from_camera, or delete the file."},
      {"0 1 0 0\n-1 0 0 0\n0 0 1 0\n1 2 3 1\n",
       ":4: expected a last row 0 0 0 1, found another.\n  Check that the matrix is written by rows, the "
       "translation "
       "in the last column."},
  };
  for (const Case& broken : cases) {
    put(name("000007", "pose.txt"), broken.text);
    EXPECT_EQ(refusal(), (folder_ / name("000007", "pose.txt")).string() + broken.rest);
  }
}

TEST_F(SevenScenesTest, a_number_beyond_time_is_refused) {
  put(name("9000000000000000000", "color.jpg"), "");
  put(name("9000000000000000000", "depth.png"), "");
  EXPECT_EQ(refusal(),
            "frame number 9000000000000000000: expected a frame number below 2.7e+11 at 30 frames per "
            "second, found "
            "9000000000000000000.\n  Number the files from 0, or list them with time stamps (TUM).");
}

}  // namespace
}  // namespace cairn
