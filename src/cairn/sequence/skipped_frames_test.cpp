// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/skipped_frames.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/core/progress.h"
#include "cairn/testing/core/message_of.h"

namespace cairn {
namespace {

using testkit::message_of;

class Listener : public Progress {
 public:
  void warn(const std::string& message) override { heard.push_back(message); }
  std::vector<std::string> heard;
};

std::exception_ptr failure(const std::string& file) {
  return std::make_exception_ptr(InputError({file, 0, "an image", "an empty file", "Copy it again."}));
}

TEST(SkippedFrames, warns_of_each_once_one_frame_was_read) {
  Listener listener;
  SkippedFrames skipped(listener);
  skipped.skip(failure("0.png"));
  EXPECT_TRUE(listener.heard.empty()) << "perhaps no frame can be read";
  skipped.take();
  skipped.skip(failure("2.png"), "frame 2 left out");
  skipped.finish();
  ASSERT_EQ(listener.heard.size(), 2U);
  EXPECT_EQ(listener.heard[0],
            "0.png: expected an image, found an empty file.\n  Copy it again. The frame is skipped.");
  EXPECT_EQ(listener.heard[1], "frame 2 left out");
  EXPECT_EQ(skipped.count(), 2);
  EXPECT_EQ(skipped.messages()[1], "2.png: expected an image, found an empty file.\n  Copy it again.");
}

TEST(SkippedFrames, one_error_says_that_none_can_be_read) {
  Listener listener;
  SkippedFrames skipped(listener);
  for (const char* name : {"0.png", "1.png", "2.png"}) skipped.skip(failure(name));
  EXPECT_EQ(
      message_of([&] { return skipped.finish(), 0; }),
      "0.png: expected an image, found an empty file; and none of 3 frames can be read.\n  Copy it again.");
  EXPECT_TRUE(listener.heard.empty());
}

TEST(SkippedFrames, the_error_of_a_lone_frame_is_its_own) {
  Listener listener;
  SkippedFrames skipped(listener);
  skipped.skip(failure("0.png"));
  EXPECT_EQ(message_of([&] { return skipped.finish(), 0; }),
            "0.png: expected an image, found an empty file.\n  Copy it again.");
}

TEST(SkippedFrames, nothing_skipped_is_no_error) {
  Listener listener;
  SkippedFrames skipped(listener);
  EXPECT_NO_THROW(skipped.finish());
  EXPECT_EQ(skipped.count(), 0);
}

TEST(SkippedFrames, very_many_are_told_in_one_sentence) {
  Listener listener;
  SkippedFrames skipped(listener);
  skipped.take();
  for (int i = 0; i < 25; ++i) skipped.skip(failure("x.png"));
  skipped.finish();
  ASSERT_EQ(listener.heard.size(), 11U);
  EXPECT_EQ(listener.heard.back(), "15 more frames cannot be read and are skipped.");
  EXPECT_EQ(skipped.count(), 25);
}

}  // namespace
}  // namespace cairn
