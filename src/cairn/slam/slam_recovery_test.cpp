// SPDX-License-Identifier: Apache-2.0
// A camera that sees nothing for a while, then only a blur, then misses two seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/slam/small_room.h"

namespace cairn {
namespace {

using testkit::error_m;
using testkit::write_small_room;

namespace fs = std::filesystem;

constexpr int kFrames = 600;                                        // once around: 18 degrees a second
constexpr std::size_t kBlank = 60, kBlurred = 200, kMissing = 350;  // where each begins
constexpr std::size_t kBad = 30, kGap = 60;                         // frames
constexpr std::size_t kAgainWithin = 10;

/// Means along the rows over `radius` pixels to both sides: what a fast turn makes of an image.
GrayImage blurred(const GrayImage& image, int radius) {
  GrayImage result(image.width(), image.height(), 0);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      int sum = 0, count = 0;
      for (int k = std::max(0, x - radius); k <= std::min(image.width() - 1, x + radius); ++k, ++count)
        sum += image(k, y);
      result(x, y) = static_cast<std::uint8_t>(sum / count);
    }
  }
  return result;
}

class SlowSlamRecovery : public testing::Test {
 protected:
  void SetUp() override { write_small_room(folder_, kFrames); }

  [[nodiscard]] Sequence damaged() const {
    Sequence sequence = open_sequence(folder_);
    const fs::path blank = folder_ / "blank.png";
    write_png(blank, GrayImage(320, 240, 90));
    for (std::size_t i = 0; i < kBad; ++i) {
      sequence.frames[kBlank + i].color = blank;
      fs::path& color = sequence.frames[kBlurred + i].color;
      const fs::path blur = folder_ / ("blur" + std::to_string(i) + ".png");
      write_png(blur, blurred(read_gray(color), 40));
      color = blur;
    }
    const auto gap = sequence.frames.begin() + static_cast<std::ptrdiff_t>(kMissing);
    sequence.frames.erase(gap, gap + static_cast<std::ptrdiff_t>(kGap));
    return sequence;
  }

  const testkit::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
  Progress progress_;
};

TEST_F(SlowSlamRecovery, is_tracked_again_within_ten_frames_each_time) {
  const Sequence sequence = damaged();
  const SlamResult result = run_slam(sequence, {}, Executor(2), progress_);
  ASSERT_EQ(result.frames.size(), sequence.frames.size());
  EXPECT_FALSE(result.frames[kBlank + kBad / 2].tracked()) << "nothing is to be seen there";
  for (const std::size_t again : {kBlank + kBad, kBlurred + kBad, kMissing}) {
    for (std::size_t i = again + kAgainWithin; i < again + 2 * kAgainWithin; ++i)
      EXPECT_TRUE(result.frames[i].tracked()) << "frame " << i;
  }
  EXPECT_EQ(result.main_component(), 0);
  EXPECT_LT(error_m(sequence, result), 0.015);
  EXPECT_GT(result.trajectory().size(), sequence.frames.size() - 2 * kBad - 3 * kAgainWithin);
}

}  // namespace
}  // namespace cairn
