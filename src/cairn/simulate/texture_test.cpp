// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/texture.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Eigen::Vector2d kFine(0.5, 0), kFineDown(0, 0.5);

RgbImage checkers(int width, int height) {
  RgbImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image(u, v) = (u + v) % 2 == 0 ? Rgb8{200, 100, 0} : Rgb8{0, 0, 0};
  return image;
}

TEST(texture, pixel_centres_read_as_painted) {
  const Texture texture(checkers(8, 6));
  EXPECT_TRUE(texture.sample({2, 2}, kFine, kFineDown).isApprox(Color(200, 100, 0)));
  EXPECT_TRUE(texture.sample({3, 2}, kFine, kFineDown).isZero());
}

TEST(texture, is_bilinear_between_centres) {
  const Texture texture(checkers(8, 6));
  EXPECT_NEAR(texture.sample({2.25, 2}, kFine, kFineDown)[0], 150, 1e-3);
}

TEST(texture, wide_footprint_sees_the_mean) {
  const Texture texture(checkers(64, 64));
  const Color far = texture.sample({31.3, 30.8}, {9, 0}, {0, 9});
  EXPECT_NEAR(far[0], 100, 1);
  EXPECT_NEAR(far[1], 50, 1);
}

TEST(texture, long_footprint_filters_along_its_long_side_only) {
  RgbImage stripes(64, 64);  // vary across, not along
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 64; ++u) stripes(u, v).r = v < 32 ? 240 : 0;
  const Texture texture(stripes);
  EXPECT_NEAR(texture.sample({32, 28}, {8, 0}, {0, 1})[0], 240, 1e-3);
  EXPECT_NEAR(texture.sample({32, 31.5}, {1, 0}, {0, 8})[0], 120, 1);
}

TEST(texture, border_is_repeated_beyond) {
  const Texture texture(checkers(8, 6));
  EXPECT_TRUE(texture.sample({-5, -5}, kFine, kFineDown).isApprox(Color(200, 100, 0)));
}

TEST(texture, needs_a_picture) {
  EXPECT_THROW(Texture{RgbImage{}}, PreconditionError);
}

}  // namespace
}  // namespace cairn
