// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr Rgb8 kWhite{255, 255, 255};

/// Area covered, pixels.
double covered(const RgbImage& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.size(); ++i) sum += image.data()[i].g / 255.0;
  return sum;
}

TEST(DrawLine, covers_its_length_times_its_width) {
  for (const double degrees : {0.0, 17.0, 45.0, 90.0, 133.0}) {
    RgbImage image(100, 100);
    const double angle = degrees * 0.0174533;
    const Eigen::Vector2d half = 35 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    draw_line(image, Eigen::Vector2d(50, 50) - half, Eigen::Vector2d(50, 50) + half, kWhite, 2);
    EXPECT_NEAR(covered(image), 70 * 2 + 3, 4) << degrees;  // round ends
    EXPECT_EQ(image(50, 50), kWhite);
  }
}

TEST(DrawLine, may_lie_outside) {
  RgbImage image(20, 10);
  draw_line(image, {-500, -300}, {-3, -2}, kWhite);
  EXPECT_EQ(covered(image), 0);
  draw_line(image, {-500, 5}, {1e6, 5}, kWhite);
  EXPECT_NEAR(covered(image), 20, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RgbImage untouched(20, 10);
  draw_line(untouched, {nan, nan}, {nan, nan}, kWhite);
  EXPECT_EQ(covered(untouched), 0);
}

TEST(DrawCircle, covers_its_circumference) {
  RgbImage image(100, 100);
  draw_circle(image, {50, 50}, 30, kWhite, 1);
  EXPECT_NEAR(covered(image), 2 * 3.14159 * 30, 4);
  EXPECT_EQ(image(80, 50), kWhite);
  EXPECT_EQ(image(50, 50), Rgb8{});
}

TEST(ColorOfHue, goes_around) {
  EXPECT_EQ(color_of_hue(0), (Rgb8{255, 0, 0}));
  EXPECT_EQ(color_of_hue(1.0 / 3), (Rgb8{0, 255, 0}));
  EXPECT_EQ(color_of_hue(2.0 / 3), (Rgb8{0, 0, 255}));
  EXPECT_EQ(color_of_hue(1.0 / 6), (Rgb8{255, 255, 0}));
  EXPECT_EQ(color_of_hue(1), color_of_hue(0));
}

}  // namespace
}  // namespace cairn
