// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <thread>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/core/message_of.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::message_of;
using testkit::RecordingFolder;

namespace fs = std::filesystem;

class FrameLoaderTest : public testing::Test, protected RecordingFolder {
 protected:
  FrameLoaderTest() {
    put("camera.yaml", kSmallCamera);
    for (const char* number : {"0", "1"}) {
      put_color("rgb/" + std::string(number) + ".png", 90);
      put_depth("depth/" + std::string(number) + ".png", 1500);
    }
  }
  [[nodiscard]] std::string refusal() const {
    const Sequence sequence = open_sequence(folder_);
    return message_of([&] { return FrameLoader(sequence).load(FrameId{1}); });
  }
  [[nodiscard]] std::string place(const std::string& name) const { return (folder_ / name).string(); }
};

TEST_F(FrameLoaderTest, loads_gray_color_and_depth) {
  const Sequence sequence = open_sequence(folder_);
  const FrameLoader loader(sequence);
  const Frame frame = loader.load(FrameId{1});
  EXPECT_EQ(frame.id, FrameId{1});
  EXPECT_EQ(frame.stamp_ns, sequence.frames[1].stamp_ns);
  EXPECT_EQ(frame.gray, GrayImage(8, 6, 90));
  EXPECT_EQ(frame.depth, DepthImage(8, 6, 1.5F));
  EXPECT_EQ(loader.load_color(FrameId{0}), RgbImage(8, 6, {90, 90, 90}));
}

TEST_F(FrameLoaderTest, loads_without_depth) {
  Sequence sequence = open_sequence(folder_);
  sequence.frames[0].depth.clear();
  sequence.calibration.depth.reset();
  EXPECT_TRUE(FrameLoader(sequence).load(FrameId{0}).depth.empty());
}

TEST_F(FrameLoaderTest, registers_the_depth_of_another_camera) {
  put("camera.yaml",
      "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 3.5, cy: 2.5}\n"
      "depth:\n  scale: 1000\n  camera: {width: 4, height: 3, fx: 5, fy: 5, cx: 1.5, cy: 1}\n"
      "  camera_from_depth: {translation: [0, 0, 0.5], quaternion_xyzw: [0, 0, 0, 1]}\n");
  write_png(folder_ / "depth/0.png", RawDepthImage(4, 3, 1500));
  const Sequence sequence = open_sequence(folder_);
  const DepthImage depth = FrameLoader(sequence).load_depth(FrameId{0});
  EXPECT_EQ(depth.width(), 8);
  EXPECT_EQ(depth.height(), 6);
  EXPECT_EQ(depth(4, 3), 2.0F);
}

TEST_F(FrameLoaderTest, images_of_another_size_are_refused) {
  write_png(folder_ / "rgb/1.png", GrayImage(9, 6));
  EXPECT_EQ(
      refusal(),
      place("rgb/1.png") +
          ": expected an image of 8x6 pixels, as the calibration says, found 9x6.\n"
          "  Give the calibration of these images, by --camera FILE or as camera.yaml in their folder.");
  put_color("rgb/1.png");
  write_png(folder_ / "depth/1.png", RawDepthImage(8, 5));
  EXPECT_EQ(
      refusal(),
      place("depth/1.png") +
          ": expected an image of 8x6 pixels, as the calibration says, found 8x5.\n"
          "  Give the calibration of these images, by --camera FILE or as camera.yaml in their folder.");
}

TEST_F(FrameLoaderTest, broken_and_missing_images_are_refused_by_name) {
  for (const char* name : {"rgb/1.png", "depth/1.png"}) {
    const std::string whole = read_file(folder_ / name);
    put(name, whole.substr(0, whole.size() / 2));
    EXPECT_TRUE(refusal().starts_with(place(name) + ": expected a whole PNG image, found ")) << refusal();
    put(name, "");
    EXPECT_TRUE(
        refusal().starts_with(place(name) + ": expected a PNG, JPEG, PGM or PPM image, found an empty file"));
    const Sequence sequence = open_sequence(folder_);
    fs::remove(folder_ / name);
    EXPECT_TRUE(message_of([&] {
                  return FrameLoader(sequence).load(FrameId{1});
                }).starts_with(place(name) + ": expected a readable file, found No such file or directory."));
    put(name, whole);
  }
  write_png(folder_ / "depth/1.png", GrayImage(8, 6));
  EXPECT_TRUE(refusal().starts_with(place("depth/1.png") +
                                    ": expected a depth image: 1 channel of 16 bit, found 1 "));
}

TEST_F(FrameLoaderTest, frames_that_are_not_there_are_errors_of_the_caller) {
  const Sequence sequence = open_sequence(folder_);
  const FrameLoader loader(sequence);
  EXPECT_THROW((void)loader.load(FrameId{2}), PreconditionError);
  EXPECT_THROW((void)loader.load(FrameId{}), PreconditionError);
}

TEST_F(FrameLoaderTest, may_be_called_from_several_threads) {
  const Sequence sequence = open_sequence(folder_);
  const FrameLoader loader(sequence);
  std::vector<Frame> frames(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < frames.size(); ++i)
      threads.emplace_back([&, i] { frames[i] = loader.load(FrameId{static_cast<int>(i % 2)}); });
  }
  for (const Frame& frame : frames) EXPECT_EQ(frame.depth, DepthImage(8, 6, 1.5F));
}

}  // namespace
}  // namespace cairn
