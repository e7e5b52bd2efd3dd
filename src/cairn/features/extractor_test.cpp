// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/extractor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// Grey squares of random place, size and brightness: corners for every detector.
GrayImage squares(int width, int height, std::uint64_t seed) {
  Random random(seed);
  GrayImage image(width, height, 128);
  for (int i = 0; i < 120; ++i) {
    const int side = 6 + static_cast<int>(random.index(30));
    const int u0 = static_cast<int>(random.index(static_cast<std::uint32_t>(width))),
              v0 = static_cast<int>(random.index(static_cast<std::uint32_t>(height)));
    const auto value = static_cast<std::uint8_t>(random.index(256));
    for (int v = v0; v < std::min(height, v0 + side); ++v) {
      for (int u = u0; u < std::min(width, u0 + side); ++u) image(u, v) = value;
    }
  }
  return image;
}

TEST(Extractor, each_detector_describes_what_it_finds) {
  const GrayImage image = squares(320, 240, 1);
  for (const std::string& name : detector_names()) {
    const auto extractor = make_extractor({name, name, 200});
    const Features features = extractor->extract(image);
    EXPECT_GT(features.keypoints.size(), 50U) << name;
    EXPECT_LE(features.keypoints.size(), 200U) << name;
    EXPECT_EQ(features.keypoints.size(), features.descriptors.count()) << name;
    EXPECT_EQ(features.descriptors.norm(), name.ends_with("SIFT") ? Norm::l2 : Norm::hamming) << name;
    for (const Keypoint& keypoint : features.keypoints) {
      EXPECT_TRUE(keypoint.u >= 0 && keypoint.u < 320 && keypoint.v >= 0 && keypoint.v < 240) << name;
      EXPECT_GE(keypoint.sigma_px, 1.0F) << name;
    }
  }
}

TEST(Extractor, repeats_itself) {
  const GrayImage image = squares(320, 240, 2);
  for (const std::string& name : detector_names()) {
    const auto extractor = make_extractor({name, name, 200});
    const Features a = extractor->extract(image), b = extractor->extract(image);
    ASSERT_EQ(a.keypoints.size(), b.keypoints.size()) << name;
    EXPECT_EQ(std::memcmp(a.descriptors.words(), b.descriptors.words(),
                          a.descriptors.count() * a.descriptors.stride()),
              0)
        << name;
  }
}

TEST(Extractor, any_image_has_a_defined_result) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 240}, {7, 5}, {31, 31}, {64, 48}, {320, 240}}) {
    for (const std::string& name : detector_names()) {
      const Features features = make_extractor({name, name, 100})->extract(GrayImage(width, height, 77));
      EXPECT_EQ(features.keypoints.size(), features.descriptors.count())
          << name << ' ' << width << 'x' << height;
      EXPECT_TRUE(features.keypoints.empty()) << name;
    }
  }
}

TEST(Extractor, a_detector_may_have_another_descriptor) {
  const Features features = make_extractor({"opencv_orb", "brisk", 150})->extract(squares(320, 240, 3));
  EXPECT_EQ(features.descriptors.bytes(), 64U);
  EXPECT_GT(features.keypoints.size(), 20U);
  EXPECT_EQ(features.keypoints.size(), features.descriptors.count());
}

TEST(Extractor, sift_may_be_described_as_rootsift) {
  const GrayImage image = squares(320, 240, 3);
  const Features plain = make_extractor({"sift", "sift", 100})->extract(image);
  const Features root = make_extractor({"sift", "rootsift", 100})->extract(image);
  ASSERT_EQ(plain.keypoints.size(), root.keypoints.size());
  EXPECT_EQ(root.descriptors.norm(), Norm::l2);
  EXPECT_NE(std::memcmp(plain.descriptors.row(0), root.descriptors.row(0), plain.descriptors.bytes()), 0);
}

std::string message_of(const FeatureOptions& options) {
  try {
    options.validate();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FeatureOptions, name_what_is_wrong) {
  EXPECT_EQ(message_of({"OBR", "ORB", 100}),
            "detector: expected one of ORB, SIFT, OPENCV_ORB, OPENCV_SIFT, AKAZE, BRISK, found 'OBR'.\n  Did "
            "you mean 'ORB'?");
  EXPECT_EQ(message_of({"ORB", "AKAZE", 100}),
            "descriptor: expected a descriptor that can describe ORB keypoints, found 'AKAZE'.\n  Set "
            "descriptor to ORB.");
  EXPECT_EQ(message_of({"ORB", "ROOTSIFT", 100}),
            "descriptor: expected a descriptor that can describe ORB keypoints, found 'ROOTSIFT'.\n  Set "
            "descriptor to ORB.");
  EXPECT_EQ(message_of({"ORB", "ORB", 0}),
            "features: expected at least 1 feature per image, found 0.\n  Leave it out for the default.");
  EXPECT_EQ(message_of({}), "");
}

}  // namespace
}  // namespace cairn
