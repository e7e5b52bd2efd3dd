// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/depth_scale.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/simulate/simulate_room.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::RecordingFolder;

namespace fs = std::filesystem;

TEST(DepthFigures, are_the_2nd_50th_and_98th_percentile) {
  std::vector<float> depths(500, 0.0F);  // unknown
  for (int i = 0; i <= 1000; ++i) depths.push_back(1.0F + 0.001F * static_cast<float>((i * 8) % 1001));
  const auto figures = depth_figures(depths);
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->nearest, 1.02, 1e-6);
  EXPECT_NEAR(figures->median, 1.5, 1e-6);
  EXPECT_NEAR(figures->farthest, 1.98, 1e-6);
}

TEST(DepthFigures, need_readings) {
  EXPECT_FALSE(depth_figures({}));
  EXPECT_FALSE(depth_figures(std::vector<float>(999, 1.0F)));
  EXPECT_FALSE(depth_figures(std::vector<float>(100000, 0.0F)));
}

TEST(LikelierScale, a_room_in_fifths_or_fives_is_noticed) {
  const DepthFigures room{0.7, 1.8, 3.9};
  EXPECT_FALSE(likelier_scale(room, 1000));
  EXPECT_EQ(likelier_scale({0.14, 0.36, 0.78}, 5000), 1000);
  EXPECT_EQ(likelier_scale({3.5, 9.0, 19.5}, 1000), 5000);
  EXPECT_EQ(likelier_scale({0.14, 0.36, 0.78}, 1000), 200) << "a factor of 5, whatever the scale";
}

TEST(LikelierScale, a_thousand_times_too_far_is_noticed) {
  EXPECT_EQ(likelier_scale({700, 1800, 3900}, 1), 1000);
  EXPECT_EQ(likelier_scale({0.0007, 0.0018, 0.0039}, 1e6), 1000);
}

TEST(LikelierScale, what_sensors_do_see_is_left_alone) {
  EXPECT_FALSE(likelier_scale({0.25, 0.45, 1.2}, 1000)) << "things on a table, near a short-range camera";
  EXPECT_FALSE(likelier_scale({1.5, 4.0, 9}, 1000)) << "a hall";
  EXPECT_FALSE(likelier_scale({0.9, 4.0, 15}, 1000)) << "a yard";
  EXPECT_FALSE(likelier_scale({4, 12, 70}, 256)) << "a street, by a laser";
  EXPECT_FALSE(likelier_scale({30, 50, 90}, 100)) << "from the air";
}

/// The doubt of a recording and of itself with a scale 5 times too large and too small.
void expect_doubt_of_wrong_scales_only(const Sequence& sequence) {
  EXPECT_EQ(doubt_depth_scale(sequence), std::nullopt) << sequence.folder;
  for (const double factor : {5.0, 0.2}) {
    Sequence wrong = sequence;
    wrong.calibration.depth->scale *= factor;
    const auto doubt = doubt_depth_scale(wrong);
    ASSERT_TRUE(doubt) << sequence.folder << " with a scale " << factor << " times as large";
    EXPECT_NE(doubt->find(fmt::format("with depth.scale {:g}", wrong.calibration.depth->scale)),
              std::string::npos)
        << *doubt;
    EXPECT_NE(doubt->find(fmt::format("with {:g} it would be", sequence.calibration.depth->scale)),
              std::string::npos)
        << *doubt;
  }
}

class DepthScaleTest : public testing::Test, protected RecordingFolder {};

TEST_F(DepthScaleTest, a_simulated_room) {
  SimulateRoomOptions options;
  options.frames_count = 40;
  options.camera = resized(options.camera, 0.25);
  const SimulatedRoom room(options);
  Sequence sequence;
  sequence.folder = folder_;
  sequence.calibration = room.calibration();
  for (int i = 0; i < options.frames_count; i += 13) {
    const SimulatedRgbdFrame frame = room.render(i);
    const fs::path color = folder_ / fmt::format("c{}.png", i), depth = folder_ / fmt::format("d{}.png", i);
    write_png(color, frame.color);
    write_png(depth, frame.depth);
    sequence.frames.push_back({i, i, color, depth, {}});
  }
  expect_doubt_of_wrong_scales_only(sequence);
  put("d0.png", "");
  expect_doubt_of_wrong_scales_only(sequence);
}

TEST_F(DepthScaleTest, nothing_is_said_of_a_sequence_without_depth) {
  Sequence sequence;
  EXPECT_FALSE(doubt_depth_scale(sequence));
  sequence.calibration.depth.emplace();
  EXPECT_FALSE(doubt_depth_scale(sequence)) << "no frames";
}

TEST(DepthScaleData, recordings) {
  const fs::path data = CAIRN_DATA_DIR;
  if (!fs::exists(data)) GTEST_SKIP() << "needs " << data;
  SequenceOptions fr1;
  fr1.camera = "tum-fr1";
  expect_doubt_of_wrong_scales_only(open_sequence(data / "rgbd/redkitchen"));
  expect_doubt_of_wrong_scales_only(open_sequence(data / "rgbd/five_views"));
  expect_doubt_of_wrong_scales_only(open_sequence(data / "rgbd/fr1_desk_excerpt", fr1));
}

}  // namespace
}  // namespace cairn
