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

class TumTest : public testing::Test, protected RecordingFolder {
 protected:
  TumTest() { make_good(); }

  void make_good() const {
    make_empty();
    put("camera.yaml", kSmallCamera);
    put("rgb.txt", "# color images\n1.00 rgb/a.png\n1.10 rgb/b.png\n1.20 rgb/c.png\n");
    put("depth.txt", "# depth maps\n1.015 depth/a.png\n1.19 depth/c.png\n1.30 depth/d.png\n");
    put("groundtruth.txt", "# t tx ty tz qx qy qz qw\n1 0 0 0 0 0 0 1\n1.2 1 0 0 0 0 0 1\n");
  }
  [[nodiscard]] std::string refusal() const {
    return message_of([&] { return open_sequence(folder_); });
  }
  [[nodiscard]] std::string place(const std::string& name) const { return (folder_ / name).string(); }
};

TEST_F(TumTest, associates_by_time) {
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.format, "TUM");
  ASSERT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.frames[0].stamp_ns, 1'000'000'000);
  EXPECT_EQ(sequence.frames[1].color, folder_ / "rgb/c.png");
  EXPECT_EQ(sequence.frames[1].depth, folder_ / "depth/c.png");
  EXPECT_EQ(sequence.frames[1].number, 1);
  EXPECT_EQ(sequence.report.color_images, 3);
  EXPECT_EQ(sequence.report.depth_images, 3);
  EXPECT_EQ(sequence.report.associated, 2);
  EXPECT_NEAR(sequence.report.max_stamp_gap_s, 0.015, 1e-12);
  EXPECT_EQ(sequence.truth->size(), 2U);
}

TEST_F(TumTest, lists_may_have_nanoseconds_tabs_and_paths_from_here) {
  const Sequence plain = open_sequence(folder_);
  put("rgb.txt", "1000000000\t./rgb/a.png\r\n1100000000\t./rgb/b.png\r\n1200000000\t./rgb/c.png\r\n");
  put("depth.txt",
      "\xEF\xBB\xBF"
      "# depth\r\n1015000000 ./depth/a.png\r\n1190000000 ./depth/c.png\r\n");
  const Sequence sequence = open_sequence(folder_);
  ASSERT_EQ(sequence.frames.size(), plain.frames.size());
  for (std::size_t i = 0; i < plain.frames.size(); ++i) {
    EXPECT_EQ(sequence.frames[i].stamp_ns, plain.frames[i].stamp_ns);
    EXPECT_EQ(sequence.frames[i].color, plain.frames[i].color);
    EXPECT_EQ(sequence.frames[i].depth, plain.frames[i].depth);
  }
}

TEST_F(TumTest, a_wider_gap_finds_more) {
  SequenceOptions options;
  options.max_stamp_gap_s = 0.21;
  EXPECT_EQ(open_sequence(folder_, options).frames.size(), 3U);
  options.max_stamp_gap_s = 0.012;
  EXPECT_EQ(open_sequence(folder_, options).frames.size(), 1U);
}

TEST_F(TumTest, associations_stand_in_for_a_list_whichever_image_comes_first) {
  fs::remove(folder_ / "depth.txt");
  for (const char* line : {"1.0 rgb/x.png 1.5 depth/y.png\n", "1.5 depth/y.png 1.0 rgb/x.png\n",
                           "1.5 ./depth/y.png 1.0 ./rgb/x.png\r\n",
                           "\xEF\xBB\xBF"
                           "1.5\tdepth/y.png\t1.0\trgb/x.png\r\n"}) {
    put("associations.txt", line);
    const Sequence sequence = open_sequence(folder_);
    ASSERT_EQ(sequence.frames.size(), 1U);
    EXPECT_EQ(sequence.frames[0].stamp_ns, 1'000'000'000);
    EXPECT_EQ(sequence.frames[0].color, folder_ / "rgb/x.png");
    EXPECT_EQ(sequence.frames[0].depth, folder_ / "depth/y.png");
    EXPECT_NEAR(sequence.report.max_stamp_gap_s, 0.5, 1e-12);
  }
}

TEST_F(TumTest, an_associations_file_goes_before_the_lists) {
  put("associations.txt", "1.0 rgb/x.png 1.5 depth/y.png\n2.0 rgb/z.png 2.5 depth/z.png\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.frames.at(0).color, folder_ / "rgb/x.png");
  EXPECT_EQ(sequence.report.associated_by, "associations.txt");
}

/// fr1_desk_excerpt has a file of 2 pairs beside lists of 9.
TEST_F(TumTest, an_associations_file_of_an_excerpt_does_not) {
  put("associations.txt", "1.0 rgb/x.png 1.5 depth/y.png\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.frames.size(), 2U);
  EXPECT_EQ(sequence.report.associated_by, "time, nearest stamp");
}

TEST_F(TumTest, truth_may_be_missing) {
  fs::remove(folder_ / "groundtruth.txt");
  EXPECT_FALSE(open_sequence(folder_).truth);
}

TEST_F(TumTest, marks_and_windows_line_ends_do_not_matter) {
  put("rgb.txt", "\xEF\xBB\xBF# color\r\n1.00 rgb/a.png \r\n\r\n");
  put("depth.txt", "1.0\tdepth/a.png\r\n");
  EXPECT_EQ(open_sequence(folder_).frames[0].color, folder_ / "rgb/a.png");
}

TEST_F(TumTest, the_folders_name_tells_the_camera) {
  fs::remove(folder_ / "camera.yaml");
  const fs::path named = folder_ / "rgbd_dataset_freiburg2_desk";
  fs::create_directories(named);
  for (const char* name : {"rgb.txt", "depth.txt"}) fs::rename(folder_ / name, named / name);
  fs::create_directory_symlink(named, folder_ / "link");
  for (const fs::path& path : {named, named / "", folder_ / "link"})
    EXPECT_EQ(open_sequence(path).calibration.camera.fx, 520.9) << path;
}

TEST_F(TumTest, one_list_alone_is_refused) {
  fs::remove(folder_ / "depth.txt");
  EXPECT_EQ(refusal(),
            place("depth.txt") +
                ": expected the list of images in TUM layout, lines `stamp path`, found no such file.\n"
                "  Both rgb.txt and depth.txt are needed, or associations.txt.");
  make_good();
  fs::remove(folder_ / "rgb.txt");
  EXPECT_TRUE(refusal().starts_with(place("rgb.txt") + ": expected the list")) << refusal();
}

TEST_F(TumTest, broken_lists_are_refused_by_line) {
  struct Case {
    const char* file;
    const char* text;
    const char* rest;
  };
  const char* const sort = ".\n  Sort the file by time and remove double stamps.";
  const char* const mend = ".\n  Correct or delete the line.";
  const Case cases[] = {
      {"rgb.txt", "1 a.png\n0.5 b.png\n", ":2: expected a time stamp after 1.000000000, found 0.500000000"},
      {"depth.txt", "1 a.png\n1 b.png\n", ":2: expected a time stamp after 1.000000000, found 1.000000000"},
      {"associations.txt", "2 a 2 b\n1 a 1 b\n",
       ":2: expected a time stamp after 2.000000000, found 1.000000000"},
      {"rgb.txt", "#\nx a.png\n", ":2: expected a time stamp in seconds, found 'x'"},
      {"rgb.txt", "1\n", ":1: expected 2 values (stamp path), found 1"},
      {"associations.txt", "1 a.png 1\n", ":1: expected 4 values (stamp rgb stamp depth), found 3"},
      {"associations.txt", "1 a.png b.png 1\n", ":1: expected a time stamp in seconds, found 'b.png'"},
  };
  for (const Case& broken : cases) {
    make_good();
    put(broken.file, broken.text);
    if (broken.file == std::string("associations.txt")) fs::remove(folder_ / "rgb.txt");
    const bool about_order = std::string(broken.rest).find("after") != std::string::npos;
    EXPECT_EQ(refusal(), place(broken.file) + broken.rest + (about_order ? sort : mend));
  }
}

TEST_F(TumTest, truth_that_goes_back_in_time_is_refused) {
  put("groundtruth.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  EXPECT_EQ(refusal(),
            place("groundtruth.txt") +
                ":2: expected a time stamp after 2.000000000, found 1.000000000.\n  Sort the file by time.");
}

TEST_F(TumTest, stamps_that_come_twice_in_the_truth_are_named) {
  put("groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  EXPECT_TRUE(open_sequence(folder_).report.warnings.empty());
  put("groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n2 0.5 0 0 0 0 0 1\n");
  const Sequence sequence = open_sequence(folder_);
  EXPECT_EQ(sequence.truth->size(), 2U);
  EXPECT_EQ(sequence.report.warnings,
            std::vector<std::string>{
                place("groundtruth.txt") +
                ":3: a second pose, 0.5 m away, at 2.000000000; 1 such line left out, the first "
                "pose counts."});
}

TEST_F(TumTest, truth_may_name_its_columns) {
  put("groundtruth.txt", "# timestamp tx ty tz qw qx qy qz\n1 1 2 3 0.8 0.2 -0.4 0.4\n");
  EXPECT_NEAR(open_sequence(folder_).truth->at(0).world_from_camera.rotation.w(), 0.8, 1e-12);
  put("groundtruth.txt", "time,east,north,up,roll,pitch,heading\n1,1,2,3,0,0,0\n");
  EXPECT_EQ(refusal(),
            place("groundtruth.txt") +
                ": expected poses of the camera, as a sequence carries them, found poses of a body (table).\n"
                "  Move the file elsewhere and give it with --poses.");
  put("groundtruth.txt", "1 0 0 10 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(refusal(),
            place("groundtruth.txt") +
                ": expected poses with time stamps, t tx ty tz qx qy qz qw a line, found poses without "
                "(KITTI).\n  Write the file in TUM format.");
}

TEST_F(TumTest, lists_of_two_clocks_are_refused) {
  put("depth.txt", "1000 depth/a.png\n");
  EXPECT_EQ(refusal(),
            place("depth.txt") +
                ": expected depth images within 0.02 s of the colour images, found none; colour begins at "
                "1.000000000, depth at 1000.000000000.\n"
                "  Check that both lists are of one recording and one clock.");
}

TEST_F(TumTest, empty_lists_are_refused) {
  put("rgb.txt", "# nothing\n");
  EXPECT_EQ(refusal(), folder_.string() +
                           ": expected at least one frame, found 0 of 0 frames after selection.\n"
                           "  Check that colour and depth images are there.");
}

TEST_F(TumTest, a_gap_that_is_none_is_refused) {
  SequenceOptions options;
  for (const double gap : {-1.0, 1e300, std::nan("")}) {
    options.max_stamp_gap_s = gap;
    EXPECT_TRUE(message_of([&] {
                  return open_sequence(folder_, options);
                }).starts_with("max_stamp_gap_s: expected seconds from 0 to 1000000, found "));
  }
}

}  // namespace
}  // namespace cairn
