// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <span>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/image_names.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

class ImagePairsTest : public testing::Test, protected RecordingFolder {
 protected:
  ImagePairsTest() {
    put("camera.yaml", kSmallCamera);
    for (const char* number : {"3", "20", "100"}) {
      put("rgb_index/" + std::string(number) + ".ppm", "");
      put("dep_index/" + std::string(number) + ".pgm", "");
    }
  }
  [[nodiscard]] std::string refusal(const SequenceOptions& options = {}) const {
    return message_of([&] { return open_sequence(folder_, options); });
  }
};

TEST_F(ImagePairsTest, orders_by_number_not_by_name) {
  put("trajectory.txt", "3 0 0 1 0 0 0 1 \n100 0 0 2 0 0 0 1\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "numbered");
  ASSERT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.frames[1].number, 20);
  EXPECT_EQ(sequence.frames[1].stamp_ns, 666'666'667);
  EXPECT_EQ(sequence.frames[2].color, folder_ / "rgb_index/100.ppm");
  ASSERT_EQ(sequence.truth->size(), 2U);
  EXPECT_EQ(sequence.truth->at(1).stamp_ns, sequence.frames[2].stamp_ns);
}

TEST_F(ImagePairsTest, numbers_are_times_only_with_a_stated_rate) {
  EXPECT_FALSE(open_sequence(folder_).has_times);
  put("camera.yaml", kSmallCamera + std::string("rate_hz: 30\n"));
  const Sequence stated = open_sequence(folder_);
  EXPECT_TRUE(stated.has_times);
  EXPECT_EQ(stated.frames[1].stamp_ns, 666'666'667);
}

TEST_F(ImagePairsTest, poses_by_time_are_no_poses_by_number) {
  put("trajectory.txt", "3.5 0 0 1 0 0 0 1\n");
  EXPECT_FALSE(open_sequence(folder_).truth);
}

TEST_F(ImagePairsTest, only_images_with_a_partner_count) {
  put("rgb_index/4.ppm", "");
  put("dep_index/5.pgm", "");
  put("rgb_index/6.txt", "");
  put("dep_index/6.txt", "");
  put("rgb_index/-7.ppm", "");
  put("dep_index/-7.pgm", "");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.frames.size(), 3U);
  EXPECT_EQ(sequence.report.color_images, 4);
  EXPECT_EQ(sequence.report.associated, 3);
}

TEST_F(ImagePairsTest, folders_and_extensions_may_be_named) {
  for (const char* number : {"1", "2"}) {
    put("left/" + std::string(number) + ".png", "");
    put("z/" + std::string(number) + ".png", "");
  }
  put("left/1.raw", "");
  put("left/2.raw", "");
  SequenceOptions options;
  options.rgb_dir = "left";
  options.depth_dir = (folder_ / "z").string();
  for (const char* extension : {"raw", ".raw"}) {
    options.rgb_extension = extension;
    const Sequence sequence = open_sequence(folder_, options);
    ASSERT_EQ(sequence.frames.size(), 2U);
    EXPECT_EQ(sequence.frames[0].color, folder_ / "left/1.raw");
  }
  options.rgb_extension.clear();
  EXPECT_EQ(open_sequence(folder_, options).frames[0].color, folder_ / "left/1.png");
}

TEST_F(ImagePairsTest, folders_of_another_machine_are_looked_for_in_the_sequence) {
  SequenceOptions options;
  options.rgb_dir = "/home/another/data/rgb_index/";
  options.depth_dir = "../data/dep_index";
  const Sequence sequence = open_sequence(folder_, options), plain = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), plain.frames.size());
  EXPECT_EQ(sequence.frames[0].color, plain.frames[0].color);
  EXPECT_EQ(sequence.frames[0].depth, plain.frames[0].depth);
  EXPECT_EQ(sequence.report.warnings,
            (std::vector<std::string>{"rgb_dir '/home/another/data/rgb_index/' is no folder here; '" +
                                          (folder_ / "rgb_index").string() + "' is taken instead",
                                      "depth_dir '../data/dep_index' is no folder here; '" +
                                          (folder_ / "dep_index").string() + "' is taken instead"}));
}

TEST_F(ImagePairsTest, one_folder_alone_is_refused) {
  SequenceOptions options;
  options.rgb_dir = "rgb_index";
  EXPECT_EQ(refusal(options),
            "depth_dir: expected a folder beside rgb_dir, found none.\n"
            "  Give both, or none for the folders' usual names.");
  options.rgb_dir.clear();
  options.depth_dir = "dep_index";
  EXPECT_EQ(refusal(options),
            "rgb_dir: expected a folder beside depth_dir, found none.\n"
            "  Give both, or none for the folders' usual names.");
}

TEST_F(ImagePairsTest, a_folder_that_is_not_there_is_refused) {
  SequenceOptions options;
  options.rgb_dir = "rgb_index";
  options.depth_dir = "nowhere";
  EXPECT_EQ(refusal(options),
            "nowhere: expected a folder with images, found no such folder.\n"
            "  Check rgb_dir and depth_dir.");
}

TEST_F(ImagePairsTest, habits_need_both_folders) {
  fs::remove_all(folder_ / "dep_index");
  EXPECT_TRUE(refusal().starts_with(folder_.string() + ": expected a sequence: TUM (rgb.txt, depth.txt)"));
  fs::rename(folder_ / "rgb_index", folder_ / "color");
  put("depth/20.png", "");
  EXPECT_EQ(open_sequence(folder_).frames.size(), 1U);
}

constexpr const char* kStereoCamera =
    "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 3.5, cy: 2.5}\nright: {baseline: 0.1}\n";

class StereoFoldersTest : public testing::Test, protected RecordingFolder {
 protected:
  StereoFoldersTest() { put("camera.yaml", kStereoCamera); }
  [[nodiscard]] std::string refusal() const {
    return message_of([&] { return open_sequence(folder_); });
  }
  /// Expects two pairs, numbers 2 and 10, of the files named.
  void expect_two_pairs(const char* left_2, const char* right_10, const SequenceOptions& options = {}) const {
    const Sequence sequence = open_sequence(folder_, options);
    ASSERT_EQ(sequence.frames.size(), 2U);
    EXPECT_TRUE(is_stereo(sequence));
    EXPECT_EQ(sequence.frames[0].number, 2);
    EXPECT_EQ(sequence.frames[0].color, folder_ / left_2);
    EXPECT_EQ(sequence.frames[1].number, 10);
    EXPECT_EQ(sequence.frames[1].right, folder_ / right_10);
  }
};

TEST_F(StereoFoldersTest, pairs_by_number_in_natural_order_whatever_the_extension) {
  for (const char* name : {"Left/10.PNG", "Left/2.jpeg", "right/02.png", "right/10.png", "right/.DS_Store",
                           "right/Thumbs.db", "Left/._2.png"})
    put(name, "");
  expect_two_pairs("Left/2.jpeg", "right/10.png");
}

TEST_F(StereoFoldersTest, series_may_lie_in_one_folder) {
  for (const char* name : {"left_2.png", "left_10.png", "right_2.png", "right_10.png"}) put(name, "");
  expect_two_pairs("left_2.png", "right_10.png");
}

TEST_F(StereoFoldersTest, the_side_may_stand_behind_the_number) {
  for (const char* name : {"2_left.png", "10_left.png", "2_right.png", "10_right.png"}) put(name, "");
  expect_two_pairs("2_left.png", "10_right.png");
}

TEST_F(StereoFoldersTest, cam0_and_cam1_need_no_lists) {
  for (const char* name : {"cam0/2.png", "cam0/10.png", "cam1/2.png", "cam1/10.png"}) put(name, "");
  expect_two_pairs("cam0/2.png", "cam1/10.png");
}

TEST_F(StereoFoldersTest, patterns_name_the_images) {
  for (const char* name : {"a/l2.png", "a/l10.png", "a/other.png", "b/r2.png", "b/r10.png"}) put(name, "");
  SequenceOptions options;
  options.left = "a/l*.png";
  options.right = (folder_ / "b").string();
  expect_two_pairs("a/l2.png", "b/r10.png", options);
  options.right = "b/x*.png";
  EXPECT_EQ(
      message_of([&] { return open_sequence(folder_, options); }),
      "--right: expected a pattern or a folder of images, in the sequence's folder or from here, found no "
      "image like 'b/x*.png'.\n  Put the pattern in quotes, for example 'left/*.png'.");
}

TEST_F(StereoFoldersTest, images_without_a_partner_are_counted) {
  for (const char* name : {"left/1.png", "left/2.png", "left/3.png", "right/2.png", "right/4.png"})
    put(name, "");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 1U);
  EXPECT_EQ(sequence.frames[0].number, 2);
  ASSERT_EQ(sequence.report.warnings.size(), 1U);
  EXPECT_EQ(sequence.report.warnings[0],
            "left/ holds 3 images, right/ holds 2: 2 and 1 of them have no partner and are left out.");
}

TEST_F(StereoFoldersTest, says_which_side_is_missing) {
  put("left/1.png", "");
  put("left/2.png", "");
  EXPECT_NE(refusal().find("found left/ holds 2 images, right/ is missing."), std::string::npos) << refusal();
}

TEST_F(StereoFoldersTest, bags_and_videos_are_named) {
  put("drive.bag", "#ROSBAG V2.0\n");
  const auto message = [&](const char* name) {
    return message_of([&] { return open_sequence(folder_ / name); });
  };
  EXPECT_NE(message("drive.bag").find("found a ROS 1 bag."), std::string::npos);
  put("walk.mp4", std::string("\0\0\0\x18"
                              "ftypisom\0\0\0\0",
                              16));
  EXPECT_NE(message("walk.mp4")
                .find("found an MP4 or QuickTime video.\n  Extract its frames: mkdir frames && "
                      "ffmpeg -i"),
            std::string::npos);
}

struct NamedStamp {
  const char* name;
  std::int64_t stamp_ns;
};

class StampedNamesTest : public testing::TestWithParam<NamedStamp> {};

TEST_P(StampedNamesTest, are_read_in_the_unit_of_their_size) {
  const SeriesFile file{"folder/image.png", GetParam().name};
  const KeyedSeries series = read_series(std::span(&file, 1));
  EXPECT_EQ(series.kind, SeriesKey::stamp);
  ASSERT_EQ(series.files.size(), 1U);
  EXPECT_EQ(series.files[0].key, GetParam().stamp_ns);
}

INSTANTIATE_TEST_SUITE_P(Units, StampedNamesTest,
                         testing::Values(NamedStamp{"1305031102.175304", 1'305'031'102'175'304'000},
                                         NamedStamp{"1305031102175", 1'305'031'102'175'000'000},
                                         NamedStamp{"1305031102175304", 1'305'031'102'175'304'000},
                                         NamedStamp{"1403636579763555584", 1'403'636'579'763'555'584},
                                         NamedStamp{"frame_1403636579_763555584",
                                                    1'403'636'579'763'555'584}));

TEST(ReadSeries, of_two_numbers_takes_the_one_that_increases) {
  const SeriesFile files[] = {{"a.png", "12-50-9"}, {"b.png", "12-51-3"}, {"c.png", "12-52-4"}};
  const KeyedSeries series = read_series(files);
  EXPECT_EQ(series.kind, SeriesKey::number);
  ASSERT_EQ(series.files.size(), 3U);
  EXPECT_EQ(series.files[2].key, 52);
}

TEST_F(ImagePairsTest, stamps_pair_within_the_gap) {
  make_empty();
  put("camera.yaml", kSmallCamera);
  for (const char* name : {"color/1305031102.175.png", "color/1305031102.275.png", "depth/1305031102.180.png",
                           "depth/1305031102.375.png"})
    put(name, "");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "stamped");
  EXPECT_TRUE(sequence.has_times);
  ASSERT_EQ(sequence.frames.size(), 1U);
  EXPECT_EQ(sequence.frames[0].stamp_ns, 1'305'031'102'175'000'000);
  EXPECT_NEAR(sequence.report.max_stamp_gap_s, 0.005, 1e-9);
}

TEST_F(ImagePairsTest, scannet_has_poses_and_intrinsics) {
  make_empty();
  for (const char* number : {"0", "1"}) {
    put_color(std::string("color/") + number + ".png");
    put_depth(std::string("depth/") + number + ".png");
  }
  put("pose/0.txt", "0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n");
  put("pose/1.txt", "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n");
  put("intrinsic/intrinsic_color.txt", "10 0 3.5 0\n0 11 2.5 0\n0 0 1 0\n0 0 0 1\n");
  put("intrinsic/intrinsic_depth.txt", "9 0 3 0\n0 9 2 0\n0 0 1 0\n0 0 0 1\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.calibration.camera.fy, 11);
  EXPECT_EQ(sequence.calibration.depth->scale, 1000);
  EXPECT_EQ(sequence.calibration.depth->camera->fx, 9);
  ASSERT_EQ(sequence.truth->size(), 1U);
  const Eigen::Vector3d point = sequence.truth->at(0).world_from_camera * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((point - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
}

TEST_F(ImagePairsTest, replica_has_a_pose_on_each_line) {
  make_empty();
  put("camera.yaml", kSmallCamera);
  for (const char* name : {"results/frame000000.jpg", "results/frame000001.jpg", "results/depth000000.png",
                           "results/depth000001.png"})
    put(name, "");
  put("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1\n");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.truth->size(), 2U);
  EXPECT_EQ(sequence.truth->at(1).world_from_camera.translation, Eigen::Vector3d(4, 5, 6));
  put("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_NE(refusal().find("traj.txt: expected 2 poses, one for each frame, found 1."), std::string::npos);
}

TEST(StampOfNumber, is_the_number_over_the_rate) {
  EXPECT_EQ(stamp_of_number(0, 30), 0);
  EXPECT_EQ(stamp_of_number(1, 30), 33'333'333);
  EXPECT_EQ(stamp_of_number(30, 30), 1'000'000'000);
  EXPECT_EQ(stamp_of_number(7, 0.5), 14'000'000'000);
  EXPECT_THROW((void)stamp_of_number(1'000'000'000'000, 30), InputError);
}

TEST(ParseFrameNumber, takes_digits_only) {
  EXPECT_EQ(parse_frame_number("000012"), 12);
  for (const char* text : {"", "-1", "1a", "1.5", "99999999999999999999"})
    EXPECT_FALSE(parse_frame_number(text)) << text;
}

}  // namespace
}  // namespace cairn
