// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/lettering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr std::string_view kAll = "0123456789abcdefghijklmnopqrstuvwxyzEN.,:-<>";

/// First and last column with ink; rows likewise.
struct Box {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Box ink(std::string_view text, const Lettering& lettering, const Eigen::Vector2d& place = {100, 60}) {
  const Rgb8 white{255, 255, 255};
  RgbImage image(300, 100, white);
  draw_text(image, place, text, lettering);
  Box box;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (image(u, v) == white) continue;
      box.left = std::min(box.left, u);
      box.right = std::max(box.right, u);
      box.top = std::min(box.top, v);
      box.bottom = std::max(box.bottom, v);
    }
  }
  return box;
}

TEST(Lettering, draws_each_letter_differently) {
  std::vector<RgbImage> drawn;
  for (const char letter : kAll) {
    RgbImage image(60, 60);
    draw_text(image, {20, 40}, std::string(1, letter), {.height_px = 24, .color = {255, 255, 255}});
    EXPECT_NE(image, RgbImage(60, 60)) << letter;
    for (const RgbImage& other : drawn) EXPECT_NE(image, other) << letter;
    drawn.push_back(image);
  }
}

TEST(Lettering, digits_stand_on_the_baseline_and_have_the_height) {
  for (const char digit : std::string("023456789")) {
    const Box box = ink(std::string(1, digit), {.height_px = 24});
    EXPECT_NEAR(box.bottom, 60, 2.5) << digit;
    EXPECT_NEAR(box.top, 60 - 24, 2.5) << digit;
  }
}

TEST(Lettering, a_text_is_as_wide_as_it_says_and_lies_at_its_anchor) {
  const std::string text = "120 m, std 0.5";
  const double width = text_width(text, 18);
  EXPECT_GT(width, 100);
  const Box start = ink(text, {.height_px = 18});
  EXPECT_NEAR(start.left, 100, 4.5);  // a '1' begins with a slope
  EXPECT_NEAR(start.right, 100 + width, 3);
  const Box middle = ink(text, {.height_px = 18, .anchor = LetteringAnchor::middle});
  EXPECT_NEAR(middle.right, 100 + 0.5 * width, 3);
  const Box end = ink(text, {.height_px = 18, .anchor = LetteringAnchor::end}, {250, 60});
  EXPECT_NEAR(end.right, 250, 3);
}

TEST(Lettering, does_not_know_other_letters) {
  RgbImage image(10, 10);
  EXPECT_THROW(draw_text(image, {0, 9}, "\xc3\xa4"), PreconditionError);
}

}  // namespace
}  // namespace cairn
