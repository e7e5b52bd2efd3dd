// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/fast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/executor.h"
#include "cairn/testing/image/random_images.h"

namespace cairn {
namespace {

using testkit::blocky_image;
using testkit::random_image;

GrayImage with_square(int side, std::uint8_t ground, std::uint8_t square) {
  GrayImage image(side, side, ground);
  for (int v = side / 4; v < 3 * side / 4; ++v)
    for (int u = side / 4; u < 3 * side / 4; ++u) image(u, v) = square;
  return image;
}

bool has_corner_near(const std::vector<Corner>& corners, int u, int v) {
  return std::any_of(corners.begin(), corners.end(),
                     [&](const Corner& c) { return std::abs(c.u - u) <= 2 && std::abs(c.v - v) <= 2; });
}

TEST(DetectFast, finds_the_corners_of_a_square_and_nothing_else) {
  const auto corners = detect_fast(with_square(80, 50, 150));
  for (const int u : {20, 59})
    for (const int v : {20, 59}) EXPECT_TRUE(has_corner_near(corners, u, v)) << u << ' ' << v;
  for (const Corner& corner : corners) {
    const bool near_u = std::abs(corner.u - 20) <= 2 || std::abs(corner.u - 59) <= 2;
    const bool near_v = std::abs(corner.v - 20) <= 2 || std::abs(corner.v - 59) <= 2;
    EXPECT_TRUE(near_u && near_v) << corner.u << ' ' << corner.v;
    EXPECT_EQ(corner.score, 99);
  }
}

TEST(DetectFast, tries_again_where_a_cell_is_empty) {
  const GrayImage dim = with_square(80, 100, 112);
  FastOptions options;
  options.retry_threshold = options.threshold;
  EXPECT_TRUE(detect_fast(dim, options).empty());
  options.retry_threshold = 7;
  EXPECT_TRUE(has_corner_near(detect_fast(dim, options), 20, 20));
}

TEST(DetectFast, no_two_corners_touch_within_a_threshold) {
  FastOptions options;
  options.retry_threshold = options.threshold;
  const auto corners = detect_fast(blocky_image(300, 200, 3), options);
  ASSERT_GT(corners.size(), 100U);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      const int du = std::abs(corners[i].u - corners[j].u), dv = std::abs(corners[i].v - corners[j].v);
      EXPECT_TRUE(du > 1 || dv > 1);
    }
  }
}

TEST(DetectFast, any_size_of_image_has_a_result_inside_the_border) {
  int count = 0;
  for (int width = 0; width < 20; ++width) {
    for (const int height : {0, 1, 8, 9, 19}) {
      for (const Corner& corner : detect_fast(random_image(width, height, 5))) {
        ++count;
        EXPECT_TRUE(corner.u >= 4 && corner.u < width - 4);
        EXPECT_TRUE(corner.v >= 4 && corner.v < height - 4);
      }
    }
  }
  EXPECT_GT(count, 10);
}

TEST(DetectFast, gives_the_same_at_any_number_of_threads) {
  const GrayImage image = blocky_image(333, 257, 6);
  const auto one = detect_fast(image);
  EXPECT_FALSE(one.empty());
  for (const int threads : {2, 3}) {
    const auto more = detect_fast(image, {}, Executor(threads));
    ASSERT_EQ(more.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(more[i].u, one[i].u);
      EXPECT_EQ(more[i].v, one[i].v);
      EXPECT_EQ(more[i].score, one[i].score);
    }
  }
}

TEST(HarrisMeasure, is_high_at_corners_negative_on_edges_and_zero_on_plain_ground) {
  const GrayImage image = with_square(80, 50, 150);
  EXPECT_GT(harris_measure(image, 20, 20), 0.0001F);
  EXPECT_LT(harris_measure(image, 20, 40), 0.0F);
  EXPECT_EQ(harris_measure(image, 40, 40), 0.0F);
}

}  // namespace
}  // namespace cairn
