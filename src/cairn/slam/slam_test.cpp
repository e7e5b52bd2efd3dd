// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/slam.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/file.h"
#include "cairn/core/progress.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/g2o_file.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/slam/small_room.h"

namespace cairn {
namespace {

using testkit::error_m;
using testkit::write_small_room;

namespace fs = std::filesystem;

constexpr int kFrames = 45;

/// A simulated sequence of 320x240 in a folder of its own, made once for all tests; each test works on a copy
/// of the list.
class SlamTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<const testkit::TemporaryFolder>();
    write_small_room(folder_->path(), kFrames);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static SlamResult run(const Sequence& sequence, int threads = 2, const SlamOptions& options = {}) {
    const Executor executor(threads);
    Progress silent;
    return run_slam(sequence, options, executor, silent);
  }

  static inline std::unique_ptr<const testkit::TemporaryFolder> folder_;
};

TEST_F(SlamTest, follows_the_camera_within_centimetres) {
  const Sequence sequence = open_sequence(folder_->path());
  const SlamResult result = run(sequence);
  EXPECT_EQ(result.trajectory().size(), static_cast<std::size_t>(kFrames));
  EXPECT_GT(result.map.keyframes().size(), 3U);
  EXPECT_LT(result.map.keyframes().size(), static_cast<std::size_t>(kFrames));
  EXPECT_GT(result.map.landmark_ids().size(), 200U);
  EXPECT_LT(error_m(sequence, result), 0.010);
}

TEST_F(SlamTest, is_the_same_at_any_number_of_threads) {
  const Sequence sequence = open_sequence(folder_->path());
  const SlamResult one = run(sequence, 1);
  for (const int threads : {2, 4}) {
    const SlamResult many = run(sequence, threads);
    EXPECT_EQ(format_tum_trajectory(many.trajectory()), format_tum_trajectory(one.trajectory())) << threads;
    EXPECT_EQ(format_g2o(many.graph_before), format_g2o(one.graph_before)) << threads;
    EXPECT_EQ(format_g2o(many.graph_after), format_g2o(one.graph_after)) << threads;
  }
}

TEST_F(SlamTest, odometry_closes_no_loops) {
  SlamOptions options;
  options.odometry = true;
  const SlamResult result = run(open_sequence(folder_->path()), 2, options);
  EXPECT_EQ(result.loops.tried, 0);
  EXPECT_EQ(result.graph_after.edges.size() + 1, result.map.keyframes().size());
}

TEST_F(SlamTest, is_lost_where_nothing_is_seen_and_finds_itself_again) {
  Sequence sequence = open_sequence(folder_->path());
  const fs::path blank = *folder_ / "blank.png";
  write_png(blank, GrayImage(320, 240, 90));
  for (std::size_t i = 20; i < 26; ++i) sequence.frames[i].color = blank;
  const SlamResult result = run(sequence);
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    EXPECT_EQ(result.frames[i].tracked(), i < 20 || i >= 26) << "frame " << i;
  }
  EXPECT_TRUE(result.frames[26].relocalized);
  EXPECT_LT(error_m(sequence, result), 0.015);
}

TEST_F(SlamTest, skips_a_frame_that_cannot_be_decoded) {
  Sequence sequence = open_sequence(folder_->path());
  const fs::path broken = *folder_ / "broken.png";
  write_file(broken, read_file(sequence.frames[10].color).substr(0, 2000));
  sequence.frames[10].color = broken;
  const SlamResult result = run(sequence);
  ASSERT_EQ(result.unreadable.size(), 1U);
  EXPECT_NE(result.unreadable[0].find("broken.png"), std::string::npos);
  EXPECT_EQ(result.frames.size(), static_cast<std::size_t>(kFrames - 1));
  EXPECT_EQ(result.trajectory().size(), static_cast<std::size_t>(kFrames - 1));
}

TEST_F(SlamTest, skips_the_first_frames_where_they_cannot_be_decoded) {
  Sequence sequence = open_sequence(folder_->path());
  const fs::path empty = *folder_ / "empty.png";
  write_file(empty, "");
  sequence.frames[0].color = empty;
  sequence.frames[1].depth = *folder_ / "missing.png";
  const SlamResult result = run(sequence);
  EXPECT_EQ(result.unreadable.size(), 2U);
  EXPECT_EQ(result.trajectory().size(), static_cast<std::size_t>(kFrames - 2));
  EXPECT_EQ(result.trajectory().front().stamp_ns, sequence.frames[2].stamp_ns);
}

TEST_F(SlamTest, frames_that_move_by_max_motion_or_more_are_refused) {
  struct Listener : Progress {
    void warn(const std::string& message) override { heard += message; }
    std::string heard;
  } listener;
  SlamOptions options;
  options.max_motion = 0.004;  // 0.4 m/s at 30 Hz are 0.013 m
  options.keyframe_threshold = 0.001;
  const SlamResult result = run_slam(open_sequence(folder_->path()), options, Executor(2), listener);
  EXPECT_LE(result.trajectory().size(), 1U);
  EXPECT_EQ(result.frames[1].status, TrackingStatus::implausible);
  EXPECT_NE(listener.heard.find("max_motion = 0.004"), std::string::npos) << listener.heard;
}

TEST_F(SlamTest, refuses_a_sequence_of_which_no_frame_can_be_decoded) {
  Sequence sequence = open_sequence(folder_->path());
  sequence.calibration.camera.width = 160;
  EXPECT_THROW((void)run(sequence), InputError);
}

TEST_F(SlamTest, keeps_what_was_done_when_the_user_stops) {
  struct StopAtTwelve : Progress {
    void update(std::int64_t done) override { last = done; }
    [[nodiscard]] bool stop_requested() const override { return last >= 12; }
    std::int64_t last = 0;
  } progress;
  const SlamResult result = run_slam(open_sequence(folder_->path()), {}, Executor(2), progress);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.frames.size(), 12U);
  EXPECT_EQ(result.trajectory().size(), 12U);
}

TEST_F(SlamTest, options_out_of_range_are_named) {
  SlamOptions options;
  options.max_motion = -1;
  try {
    options.validate();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "max_motion: expected rad + m above 0, found -1.\n  Leave it out for the default.");
  }
}

}  // namespace
}  // namespace cairn
