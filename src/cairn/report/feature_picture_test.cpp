// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/feature_picture.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

bool is_grey(const Rgb8& pixel) {
  return pixel.r == pixel.g && pixel.g == pixel.b;
}

TEST(DrawKeypoints, puts_a_circle_around_each) {
  const GrayImage image(60, 40, 100);
  const RgbImage plain = draw_keypoints(image, {});
  EXPECT_EQ(plain.width(), 60);
  EXPECT_TRUE(is_grey(plain(20, 20)));
  const std::vector<Keypoint> keypoints{{20, 20, 40, 0}, {45, 20, 80, -1}};  // circles of radius 6 and 12
  const RgbImage picture = draw_keypoints(image, keypoints);
  EXPECT_EQ(picture(14, 20), (Rgb8{0, 0, 255}));
  EXPECT_FALSE(is_grey(picture(23, 20)));  // its angle is 0
  EXPECT_TRUE(is_grey(picture(17, 20)));
  EXPECT_EQ(picture(57, 20), (Rgb8{255, 0, 0}));
  EXPECT_TRUE(is_grey(picture(48, 20)));  // it has no angle
}

TEST(DrawMatches, connects_both_images) {
  const GrayImage first(30, 20, 50), second(40, 25, 90);
  const std::vector<Keypoint> a{{5, 10}}, b{{8, 3}, {35, 10}};
  const RgbImage picture = draw_matches(first, a, second, b, std::vector<Match>{{0, 1, 3}});
  EXPECT_EQ(picture.width(), 70);
  EXPECT_EQ(picture.height(), 25);
  EXPECT_FALSE(is_grey(picture(20, 10)));
  EXPECT_FALSE(is_grey(picture(60, 10)));
  EXPECT_TRUE(is_grey(picture(38, 3)));
  EXPECT_EQ(picture(0, 24), Rgb8{});  // the first image is not that high
}

}  // namespace
}  // namespace cairn
