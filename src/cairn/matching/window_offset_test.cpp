// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/window_offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// Makes a smooth texture, seen `offset` further; its column is stretched by `slope` a pixel of the row.
GrayImage texture(const Eigen::Vector2d& offset, double slope = 0) {
  GrayImage image(80, 60);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double x = u - offset.x() - slope * (v - 30), y = v - offset.y();
      const double grey = 128 + 50 * std::sin(0.5 * x + 0.2 * y) + 40 * std::cos(0.45 * y - 0.15 * x + 1);
      image(u, v) = static_cast<std::uint8_t>(std::lround(grey));
    }
  }
  return image;
}

TEST(WindowOffset, finds_an_offset_in_both_directions_to_a_fiftieth_of_a_pixel) {
  const Eigen::Vector2d planted(-6.37, 0.81);
  const auto found = measure_offset(texture({0, 0}), texture(planted), {40, 30}, {-6, 0}, 3);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->offset.x(), planted.x(), 0.02);
  EXPECT_NEAR(found->offset.y(), planted.y(), 0.02);
  EXPECT_GT(found->correlation, 0.99);
  EXPECT_GT(found->sigma_px, 0);
  EXPECT_LT(found->sigma_px, 0.05);
}

TEST(WindowOffset, is_not_moved_by_a_slope_of_the_disparity) {
  const auto found = measure_offset(texture({0, 0}), texture({-6.4, 0.3}, 0.2), {40, 30}, {-6, 0}, 3);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->offset.x(), -6.4 + 0.3 * 0.2, 0.02);  // 0.3 rows further down
  EXPECT_NEAR(found->offset.y(), 0.3, 0.02);
}

TEST(WindowOffset, finds_nothing_without_texture_room_or_reach) {
  const GrayImage flat(80, 60, 100);
  GrayImage stripes(80, 60);  // the row of an edge along it cannot be told
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 80; ++u) stripes(u, v) = static_cast<std::uint8_t>(128 + 100 * std::sin(0.5 * u));
  const GrayImage seen = texture({0, 0});
  EXPECT_FALSE(measure_offset(flat, flat, {40, 30}, {0, 0}, 3));
  EXPECT_FALSE(measure_offset(stripes, stripes, {40, 30}, {0, 0}, 3));
  EXPECT_FALSE(measure_offset(seen, seen, {4, 30}, {0, 0}, 3));
  EXPECT_FALSE(measure_offset(seen, seen, {40, 30}, {-35, 0}, 3));
  EXPECT_FALSE(measure_offset(seen, texture({2, 0}), {40, 30}, {0, 0}, 1));
  EXPECT_FALSE(measure_offset(seen, seen, {std::nan(""), 30}, {0, 0}, 3));
  EXPECT_THROW((void)measure_offset(seen, GrayImage(80, 61), {40, 30}, {0, 0}, 3), PreconditionError);
}

}  // namespace
}  // namespace cairn
