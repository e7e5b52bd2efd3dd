// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/localization_picture.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(LocalizationPicture, inliers_are_green_and_outliers_red) {
  const GrayImage image(60, 40, 100);
  const RgbImage picture =
      draw_localization(image, {{{15, 20}, {15, 20}, true}, {{40, 20}, {40, 30}, false}});
  EXPECT_EQ(picture.width(), 60);
  EXPECT_EQ(picture(0, 0), (Rgb8{75, 75, 75}));  // the image, dimmed
  const Rgb8 inlier = picture(19, 20), outlier = picture(44, 20);
  EXPECT_GT(inlier.g, inlier.r);
  EXPECT_GT(outlier.r, outlier.g);
  EXPECT_GT(picture(40, 27).r, 150);  // on the line to where the landmark is
}

}  // namespace
}  // namespace cairn
