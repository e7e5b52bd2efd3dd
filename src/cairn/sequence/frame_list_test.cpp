// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/frame_list.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

class FrameListTest : public testing::Test, protected RecordingFolder {
 protected:
  using Numbers = std::vector<std::int64_t>;

  [[nodiscard]] Numbers read(const std::string& text) const {
    return read_frame_list(write("keyframe.txt", text));
  }
  [[nodiscard]] Numbers chosen(const Numbers& numbers) const {
    SequenceOptions options;
    options.frame_numbers = numbers;
    Numbers positions;
    for (const FrameFiles& files : open_sequence(folder_, options).frames)
      positions.push_back(files.position);
    return positions;
  }
};

TEST_F(FrameListTest, has_keyframes_and_their_frames_or_frames_alone) {
  EXPECT_EQ(read("0 1\n1 8\n2 17\n"), (Numbers{1, 8, 17}));
  EXPECT_EQ(read("17\r\n1\r\n\r\n8\n8\n"), (Numbers{1, 8, 17}));
}

TEST_F(FrameListTest, refuses_what_is_no_number) {
  for (const char* line : {"1 2 3", "0 a", "0 1.5", "-1"})
    EXPECT_EQ(message_of([&] { return read(std::string("0 1\n") + line); }),
              (folder_ / "keyframe.txt").string() +
                  ":2: expected the number of a frame, or of a keyframe and its frame, found '" + line +
                  "'.\n  Correct or delete the line.");
  EXPECT_NE(message_of([&] { return read("\n"); }).find("expected numbers of frames"), std::string::npos);
}

TEST_F(FrameListTest, chooses_numbered_files_by_number) {
  put("camera.yaml", kSmallCamera);
  for (const char* number : {"1", "2", "3", "5"}) {
    put_color("rgb_index/" + std::string(number) + ".png");
    put_depth("dep_index/" + std::string(number) + ".png");
  }
  EXPECT_EQ(chosen({2, 4, 5}), (Numbers{1, 3}));
  EXPECT_THROW((void)chosen({4}), InputError);
}

TEST_F(FrameListTest, chooses_listed_frames_from_one_on) {
  put("camera.yaml", kSmallCamera);
  put("rgb.txt", "1.0 a.png\n1.1 a.png\n1.2 a.png\n");
  put("depth.txt", "1.0 d.png\n1.1 d.png\n1.2 d.png\n");
  put_color("a.png");
  put_depth("d.png");
  EXPECT_EQ(chosen({1, 3}), (Numbers{0, 2}));
}

}  // namespace
}  // namespace cairn
