// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

class NumberedTest : public testing::Test, protected RecordingFolder {
 protected:
  NumberedTest() {
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

TEST_F(NumberedTest, orders_by_number_not_by_name) {
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

TEST_F(NumberedTest, numbers_are_times_only_with_a_stated_rate) {
  EXPECT_FALSE(open_sequence(folder_).has_times);
  put("camera.yaml", kSmallCamera + std::string("rate_hz: 30\n"));
  const Sequence stated = open_sequence(folder_);
  EXPECT_TRUE(stated.has_times);
  EXPECT_EQ(stated.frames[1].stamp_ns, 666'666'667);
}

TEST_F(NumberedTest, poses_by_time_are_no_poses_by_number) {
  put("trajectory.txt", "3.5 0 0 1 0 0 0 1\n");
  EXPECT_FALSE(open_sequence(folder_).truth);
}

TEST_F(NumberedTest, only_images_with_a_partner_count) {
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

TEST_F(NumberedTest, folders_and_extensions_may_be_named) {
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

TEST_F(NumberedTest, folders_of_another_machine_are_looked_for_in_the_sequence) {
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

TEST_F(NumberedTest, one_folder_alone_is_refused) {
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

TEST_F(NumberedTest, a_folder_that_is_not_there_is_refused) {
  SequenceOptions options;
  options.rgb_dir = "rgb_index";
  options.depth_dir = "nowhere";
  EXPECT_EQ(refusal(options),
            "nowhere: expected a folder with numbered images, found no such folder.\n"
            "  Check rgb_dir and depth_dir.");
}

TEST_F(NumberedTest, habits_need_both_folders) {
  fs::remove_all(folder_ / "dep_index");
  EXPECT_TRUE(refusal().starts_with(folder_.string() + ": expected a sequence: TUM (rgb.txt, depth.txt)"));
  fs::rename(folder_ / "rgb_index", folder_ / "color");
  put("depth/20.png", "");
  EXPECT_EQ(open_sequence(folder_).frames.size(), 1U);
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
