// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/resize.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cairn {
namespace {

/// A smooth picture over the area [0, 1] x [0, 1], each pixel the value at its centre.
GrayImage painted(int width, int height) {
  GrayImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image(u, v) = static_cast<std::uint8_t>(
          std::lround(127 + 60 * std::sin(5 * (u + 0.5) / width) + 60 * std::cos(4 * (v + 0.5) / height)));
  return image;
}

TEST(Resize, a_pixel_is_the_mean_of_the_area_that_it_covers) {
  GrayImage image(4, 2);
  for (int i = 0; i < 8; ++i) image.data()[i] = static_cast<std::uint8_t>(12 * i);
  EXPECT_EQ(resize_image(image, 2, 1)(0, 0), 30);  // 0 12 48 60
  EXPECT_EQ(resize_image(image, 2, 1)(1, 0), 54);
  const GrayImage thirds = resize_image(image, 3, 2);  // 4/3 pixels each
  EXPECT_EQ(thirds(0, 0), 3);                          // (0 + 12/3) / (4/3)
  EXPECT_EQ(thirds(1, 0), 18);
  EXPECT_EQ(thirds(2, 0), 33);
}

TEST(Resize, the_same_picture_at_any_size) {
  const GrayImage image = painted(160, 120);
  for (const auto& [width, height] : {std::pair(64, 48), {107, 80}, {160, 120}, {240, 180}, {320, 60}}) {
    const GrayImage resized = resize_image(image, width, height), expected = painted(width, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) ASSERT_NEAR(resized(u, v), expected(u, v), 2) << u << " " << v;
  }
  EXPECT_EQ(resize_image(image, 160, 120), image);
}

TEST(Resize, white_stays_white_and_one_pixel_is_enough) {
  EXPECT_EQ(resize_image(GrayImage(37, 11, 255), 10, 7), GrayImage(10, 7, 255));
  EXPECT_EQ(resize_image(GrayImage(1, 1, 9), 3, 2), GrayImage(3, 2, 9));
  EXPECT_THROW((void)resize_image(GrayImage(), 3, 2), PreconditionError);
  EXPECT_THROW((void)resize_image(GrayImage(1, 1), 0, 2), PreconditionError);
}

TEST(Resize, depth_is_never_between_two_surfaces) {
  DepthImage depth(6, 2, 1.0F);
  for (int u = 3; u < 6; ++u) depth(u, 0) = depth(u, 1) = 4.0F;
  depth(0, 0) = 0;
  const DepthImage small = resize_depth(depth, 4, 1);
  for (int u = 0; u < 4; ++u) EXPECT_EQ(small(u, 0), u < 2 ? 1.0F : 4.0F) << u;
  EXPECT_EQ(resize_depth(depth, 12, 4)(1, 1), 0.0F);
}

/// Where a point is in the picture, as a share of its width and height, does not change.
TEST(Resize, the_camera_sees_a_point_at_the_same_place_of_the_picture) {
  Camera camera{CameraModel::radtan, 1600, 1200, 1300, 1310, 790.2, 612.5, {-0.2, 0.05, 0.001, 0.002, 0.01}};
  const Eigen::Vector3d point(0.3, -0.2, 1.1);
  const Eigen::Vector2d pixel = camera.project(point).value();
  for (const auto& [width, height] : {std::pair(640, 480), {641, 479}, {3200, 2400}}) {
    const Camera resized = resized_camera(camera, width, height);
    const Eigen::Vector2d moved = resized.project(point).value();
    EXPECT_NEAR((moved.x() + 0.5) / width, (pixel.x() + 0.5) / 1600, 1e-12);
    EXPECT_NEAR((moved.y() + 0.5) / height, (pixel.y() + 0.5) / 1200, 1e-12);
    const Eigen::Vector2d ray = resized.unproject(moved).value();
    EXPECT_LT((ray - point.head<2>() / point.z()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace cairn
