// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/observe_frames.h"

#include <gtest/gtest.h>

#include <atomic>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::RecordingFolder;

constexpr int kFrames = 6;

/// Listens, and stops after `stop_after` frames if that is not 0.
struct Listener : Progress {
  void start(std::string_view stage, std::int64_t total, std::string_view unit) override {
    begun = std::string(stage) + " " + std::to_string(total) + " " + std::string(unit);
  }
  void update(std::int64_t done) override { updated.push_back(done); }
  void warn(const std::string& message) override { warnings.push_back(message); }
  [[nodiscard]] bool stop_requested() const override {
    return stop_after > 0 && static_cast<int>(updated.size()) >= stop_after;
  }

  std::string begun;
  std::vector<std::int64_t> updated;
  std::vector<std::string> warnings;
  int stop_after = 0;
};

class ObserveFramesTest : public testing::Test, protected RecordingFolder {
 protected:
  ObserveFramesTest() {
    put("camera.yaml", kSmallCamera);
    for (int i = 0; i < kFrames; ++i) {
      put_color("rgb/" + std::to_string(i) + ".png");
      put_depth("depth/" + std::to_string(i) + ".png");
    }
  }

  FrameStreamReport observe(int threads, std::vector<std::size_t> indices = {0, 1, 2, 3, 4, 5}) {
    const Sequence sequence = open_sequence(folder_);
    const FrameObserver observer(sequence, ObserverOptions());
    FrameStream stream{"looking", "image"};
    stream.process = [&](std::size_t index, LoadedFrame&& loaded) {
      processed_.push_back(index);
      if (loaded.failure) failed_.push_back(index);
    };
    stream.prepare = [&](std::size_t, const LoadedFrame&) { ++prepared_; };
    return observe_frames(sequence, observer, indices, stream, Executor(threads), listener_);
  }

  Listener listener_;
  std::vector<std::size_t> processed_, failed_;
  std::atomic<int> prepared_ = 0;
};

TEST_F(ObserveFramesTest, frames_come_in_order_with_progress) {
  for (const int threads : {1, 3}) {
    processed_.clear();
    const FrameStreamReport report = observe(threads, {1, 2, 4});
    EXPECT_EQ(processed_, (std::vector<std::size_t>{1, 2, 4}));
    EXPECT_FALSE(report.stopped);
    EXPECT_TRUE(report.unreadable.empty());
  }
  EXPECT_EQ(prepared_, 6);
  EXPECT_EQ(listener_.begun, "looking 6 images");
  EXPECT_EQ(listener_.updated, (std::vector<std::int64_t>{2, 3, 5, 2, 3, 5}));
}

TEST_F(ObserveFramesTest, an_unreadable_frame_is_named_and_not_prepared) {
  put("rgb/0.png", "no image");
  const FrameStreamReport report = observe(2);
  EXPECT_EQ(processed_.size(), 6U);
  EXPECT_EQ(failed_, (std::vector<std::size_t>{0}));
  EXPECT_EQ(prepared_, 5);
  ASSERT_EQ(report.unreadable.size(), 1U);
  EXPECT_NE(report.unreadable.front().find("0.png"), std::string::npos);
  EXPECT_EQ(listener_.warnings.size(), 1U);
}

TEST_F(ObserveFramesTest, a_sequence_without_a_readable_frame_is_an_error) {
  for (int i = 0; i < kFrames; ++i) put("rgb/" + std::to_string(i) + ".png", "no image");
  EXPECT_THROW((void)observe(2), InputError);
}

TEST_F(ObserveFramesTest, stops_on_request_before_the_last_frame) {
  listener_.stop_after = 3;
  EXPECT_TRUE(observe(2).stopped);
  EXPECT_EQ(processed_, (std::vector<std::size_t>{0, 1, 2}));
  listener_ = {};
  listener_.stop_after = kFrames;
  EXPECT_FALSE(observe(2).stopped);
}

}  // namespace
}  // namespace cairn
