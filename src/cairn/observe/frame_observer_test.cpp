// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/frame_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"
#include "cairn/image/codec.h"
#include "cairn/image/resize.h"
#include "cairn/sequence/sequence.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::RecordingFolder;

constexpr int kWidth = 640, kHeight = 480, kBlock = 20;
constexpr double kFocal = 500;

/// Blocks of random grey, seen from so many pixels further to the right.
GrayImage blocks(int shift) {
  GrayImage image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const int block = v / kBlock * 1000 + (u + shift) / kBlock;
      image(u, v) = static_cast<std::uint8_t>(40 + Random(7, static_cast<std::uint64_t>(block)).index(170));
    }
  return image;
}

class FrameObserverTest : public testing::Test, protected RecordingFolder {
 protected:
  /// What is observed of the first frame at half its size.
  [[nodiscard]] std::vector<Observation> observed_at_half_size() const {
    const Sequence sequence = open_sequence(folder_);
    const Camera half = resized_camera(sequence.calibration.camera, kWidth / 2, kHeight / 2);
    const FrameObserver observer(sequence, ObserverOptions(), half);
    const LoadedFrame loaded = observer.load(0);
    EXPECT_EQ(loaded.error, "");
    for (const Keypoint& keypoint : loaded.observed.features.keypoints) {
      EXPECT_LT(keypoint.u, kWidth / 2);
      EXPECT_LT(keypoint.v, kHeight / 2);
    }
    return loaded.observed.observations;
  }
  [[nodiscard]] static std::string camera_yaml() {
    return "camera: {width: 640, height: 480, fx: 500, fy: 500, cx: 319.5, cy: 239.5}\n";
  }
  void put_image(const std::string& name, const GrayImage& image) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_png(folder_ / name, image);
  }
};

TEST_F(FrameObserverTest, depth_is_resized_with_the_image) {
  constexpr double kDepth = 2;
  put("camera.yaml", camera_yaml() + "depth: {scale: 1000}\n");
  put_image("rgb/1.png", blocks(0));
  std::filesystem::create_directories(folder_ / "depth");
  write_png(folder_ / "depth/1.png", RawDepthImage(kWidth, kHeight, 2000));
  const std::vector<Observation> seen = observed_at_half_size();
  ASSERT_GT(seen.size(), 100U);
  for (const Observation& observation : seen)
    EXPECT_NEAR(observation.d, kFocal / 2 * DepthNoise().baseline / kDepth, 1e-6);
}

TEST_F(FrameObserverTest, both_images_of_a_pair_are_resized) {
  constexpr int kDisparity = 40;
  put("camera.yaml", camera_yaml() + "right: {baseline: 0.5}\n");
  put_image("image_0/000000.png", blocks(0));
  put_image("image_1/000000.png", blocks(kDisparity));
  put("times.txt", "0\n");
  std::size_t measured = 0;
  for (const Observation& observation : observed_at_half_size()) {
    if (!observation.has_disparity()) continue;
    ++measured;
    EXPECT_NEAR(observation.d, kDisparity / 2.0, 0.5);
  }
  EXPECT_GT(measured, 100U);
}

TEST_F(FrameObserverTest, a_field_is_taken_off_in_the_pixels_of_resized_images) {
  constexpr int kDisparity = 40;
  constexpr double kField = 6;  // pixels of the images as they are on disk
  put("camera.yaml", camera_yaml() + "right: {baseline: 0.5}\n");
  put_image("image_0/000000.png", blocks(0));
  put_image("image_1/000000.png", blocks(kDisparity));
  put("times.txt", "0\n");
  Sequence sequence = open_sequence(folder_);
  sequence.calibration.right_correction.emplace().disparity = {kField, 0, 0};
  for (const int part : {1, 2}) {
    const Camera resized = resized_camera(sequence.calibration.camera, kWidth / part, kHeight / part);
    const ObservedFrame observed = FrameObserver(sequence, {}, resized).load(0).observed;
    int measured = 0, right = 0;
    for (const Observation& seen : observed.observations) {
      measured += seen.has_disparity() ? 1 : 0;
      right += std::abs(seen.d - (kDisparity - kField) / part) < 0.5 ? 1 : 0;
    }
    EXPECT_GT(measured, 100) << part;
    EXPECT_GT(right, 0.98 * measured) << part;  // blocks look alike: some match wrongly
  }
}

}  // namespace
}  // namespace cairn
