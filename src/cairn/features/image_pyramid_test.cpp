// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/image_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/executor.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::random_image;

GrayImage ramp(int width, int height) {
  GrayImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image(u, v) = static_cast<std::uint8_t>(std::lround(u * 0.3 + v * 0.4));
  return image;
}

TEST(ImagePyramid, levels_shrink_by_the_scale) {
  const ImagePyramid pyramid = build_pyramid(random_image(640, 480, 1), {8, 1.2, 39});
  ASSERT_EQ(pyramid.levels.size(), 8U);
  EXPECT_EQ(pyramid.levels[1].image.width(), 533);
  EXPECT_EQ(pyramid.levels[1].image.height(), 400);
  EXPECT_EQ(pyramid.levels[7].image.width(), 179);
  EXPECT_NEAR(pyramid.levels[7].scale_u, std::pow(1.2, 7), 0.02);
}

TEST(ImagePyramid, stops_at_the_smallest_side) {
  EXPECT_EQ(build_pyramid(random_image(60, 50, 1), {8, 1.2, 39}).levels.size(), 2U);
  EXPECT_EQ(build_pyramid(random_image(60, 38, 1), {8, 1.2, 39}).levels.size(), 0U);
  EXPECT_EQ(build_pyramid(GrayImage(), {8, 1.2, 1}).levels.size(), 0U);
  EXPECT_EQ(build_pyramid(random_image(15, 15, 1), {8, 1.2, 1}).levels.size(), 1U);
}

TEST(ImagePyramid, places_are_those_of_the_image) {
  const GrayImage image = ramp(320, 240);
  const ImagePyramid pyramid = build_pyramid(image, {6, 1.2, 39});
  EXPECT_EQ(pyramid.levels.size(), 6U);
  for (const auto& level : pyramid.levels) {
    for (int v = 2; v < level.image.height() - 2; v += 5) {
      for (int u = 2; u < level.image.width() - 2; u += 5) {
        const double expected = level.u_in_image(u) * 0.3 + level.v_in_image(v) * 0.4;
        ASSERT_NEAR(level.image(u, v), expected, 1.5) << u << ' ' << v << " of " << level.image.width();
      }
    }
  }
}

TEST(ResizeBilinear, keeps_one_colour_and_its_size_by_one) {
  const GrayImage white(50, 40, 255);
  EXPECT_EQ(resize_bilinear(white, 33, 25), GrayImage(33, 25, 255));
  const GrayImage image = random_image(50, 40, 2);
  EXPECT_EQ(resize_bilinear(image, 50, 40), image);
  EXPECT_THROW((void)resize_bilinear(image, 20, 40), PreconditionError);
}

TEST(SmoothForBrief, keeps_one_colour_and_spreads_a_point) {
  EXPECT_EQ(smooth_for_brief(GrayImage(70, 9, 200)), GrayImage(70, 9, 200));
  GrayImage point(80, 21, 0);
  point(40, 10) = 255;
  const GrayImage smooth = smooth_for_brief(point);
  EXPECT_EQ(smooth(40, 10), 11);  // (54 / 256)^2 of 255
  EXPECT_EQ(smooth(43, 10), 4);
  EXPECT_EQ(smooth(44, 10), 0);
  EXPECT_EQ(smooth(40, 7), smooth(43, 10));
}

TEST(SmoothForBrief, has_a_mirror_at_the_border_and_takes_any_size) {
  GrayImage image(9, 9, 0);
  for (int v = 0; v < 9; ++v) image(1, v) = 200;
  EXPECT_NEAR(smooth_for_brief(image)(0, 4), 200 * 2 * 49 / 256.0, 1);  // the column once more at -1
  for (int width = 1; width < 9; ++width)
    for (int height = 1; height < 9; ++height)
      EXPECT_EQ(smooth_for_brief(GrayImage(width, height, 99)), GrayImage(width, height, 99));
}

TEST(ImagePyramid, is_the_same_at_any_number_of_threads) {
  const GrayImage image = random_image(400, 300, 4);
  const auto one = build_pyramid(image, {8, 1.2, 39}),
             three = build_pyramid(image, {8, 1.2, 39}, Executor(3));
  for (std::size_t l = 0; l < one.levels.size(); ++l) EXPECT_EQ(one.levels[l].image, three.levels[l].image);
  EXPECT_EQ(smooth_for_brief(image), smooth_for_brief(image, Executor(3)));
}

}  // namespace
}  // namespace cairn
