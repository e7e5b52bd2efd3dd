// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/pair_order.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <utility>

#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/image/textured_pair.h"

namespace cairn {
namespace {

using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 240;

Sequence exchanged(Sequence sequence) {
  for (FrameFiles& files : sequence.frames) std::swap(files.color, files.right);
  return sequence;
}

class PairOrderTest : public testing::Test, protected RecordingFolder {
 protected:
  /// Three pairs of a surface; contrast 0: without texture.
  [[nodiscard]] Sequence without_pairs() const {
    Sequence sequence;
    sequence.folder = folder_;
    sequence.format = "KITTI";
    sequence.calibration.camera = {CameraModel::pinhole, kWidth, kHeight, 260, 260, 160, 120, {}};
    sequence.calibration.baseline = 0.5;
    sequence.calibration_source = "calib.txt";
    return sequence;
  }

  [[nodiscard]] Sequence pairs_of(const testkit::Surface& surface, double contrast) const {
    Sequence sequence = without_pairs();
    for (int i = 0; i < 3; ++i) {
      const testkit::Waves waves(8, contrast, static_cast<std::uint64_t>(i));
      const testkit::TestPair pair = testkit::make_pair(kWidth, kHeight, surface, waves, 1, 1);
      const fs::path left = folder_ / fmt::format("l{}.png", i), right = folder_ / fmt::format("r{}.png", i);
      write_png(left, pair.left);
      write_png(right, pair.right);
      sequence.frames.push_back({i, i, left, {}, right});
    }
    return sequence;
  }
};

TEST_F(PairOrderTest, one_good_pair_is_enough) {
  const PairOrder order = measure_pair_order(pairs_of({12, 0.01, 0.02}, 30));
  EXPECT_EQ(order.pairs, 1);
  EXPECT_GT(order.as_given, 100);
  EXPECT_FALSE(order.looks_exchanged());
}

TEST_F(PairOrderTest, exchanged_images_are_named_with_the_figures) {
  const Sequence sequence = exchanged(pairs_of({12, 0.01, 0.02}, 30));
  const PairOrder order = measure_pair_order(sequence);
  EXPECT_GT(order.exchanged, 100);
  EXPECT_LT(order.as_given, 20);
  ASSERT_TRUE(order.looks_exchanged());
  const std::string message = message_of([&] { return check_pair_order(sequence), 0; });
  EXPECT_NE(message.find("left and right images that look exchanged"), std::string::npos) << message;
  EXPECT_NE(message.find(fmt::format("{} with left and right exchanged", order.exchanged)), std::string::npos)
      << message;
  EXPECT_NE(message.find("Exchange the images of image_0 and image_1"), std::string::npos) << message;
}

/// Nothing is said of scenes that do not tell.
TEST_F(PairOrderTest, far_scenes_and_walls_without_texture_are_no_error) {
  for (const Sequence& sequence : {pairs_of({1, 0, 0}, 30), pairs_of({12, 0, 0}, 0)}) {
    EXPECT_NO_THROW(check_pair_order(sequence));
    EXPECT_NO_THROW(check_pair_order(exchanged(sequence)));
  }
}

/// Half of the image says one thing, half the other: no clear ratio.
TEST_F(PairOrderTest, contradictory_images_are_no_error) {
  const Sequence sequence = pairs_of({0, 0.2, 0}, 30);
  EXPECT_NO_THROW(check_pair_order(sequence));
  EXPECT_NO_THROW(check_pair_order(exchanged(sequence)));
}

TEST_F(PairOrderTest, pairs_that_cannot_be_read_are_passed_over) {
  const Sequence sequence = exchanged(pairs_of({12, 0, 0}, 30));
  put("l0.png", "");
  fs::remove(folder_ / "r1.png");
  EXPECT_TRUE(measure_pair_order(sequence).looks_exchanged());
  put("r2.png", "no image");
  EXPECT_EQ(measure_pair_order(sequence).pairs, 0);
}

TEST_F(PairOrderTest, a_sequence_without_right_images_has_no_order) {
  Sequence sequence = pairs_of({12, 0, 0}, 30);
  for (FrameFiles& files : sequence.frames) files.right.clear();
  EXPECT_EQ(measure_pair_order(sequence).pairs, 0);
}

/// Rectified grey pairs, a pair with a calibration that is off by 2 pixels, and raw pairs.
TEST(PairOrderData, recordings_are_told_from_their_exchanged_selves) {
  for (const char* name : {"kitti_0039", "odo01", "euroc_v101"}) {
    const fs::path folder = fs::path(CAIRN_DATA_DIR) / "stereo" / name;
    if (!fs::exists(folder)) GTEST_SKIP() << "needs " << folder;
    const Sequence sequence = open_sequence(folder);
    EXPECT_NO_THROW(check_pair_order(sequence)) << name;
    const PairOrder order = measure_pair_order(exchanged(sequence));
    EXPECT_TRUE(order.looks_exchanged()) << name << ": " << order.as_given << " and " << order.exchanged;
  }
}

}  // namespace
}  // namespace cairn
