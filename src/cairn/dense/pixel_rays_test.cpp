// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/pixel_rays.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

TEST(PixelRays, are_those_of_the_camera) {
  Camera camera = testkit::small_camera();
  camera.model = CameraModel::radtan;
  camera.distortion = {-0.2, 0.05, 0.001, -0.002};
  const PixelRays rays(camera);
  ASSERT_EQ(rays.width(), 64);
  ASSERT_EQ(rays.height(), 48);
  double longest = 0;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const Eigen::Vector3d ray(rays.x_row(v)[u], rays.y_row(v)[u], 1);
      const auto pixel = camera.project(ray);
      ASSERT_TRUE(pixel) << u << " " << v;
      EXPECT_LT((*pixel - Eigen::Vector2d(u, v)).norm(), 1e-6) << u << " " << v;
      longest = std::max(longest, ray.norm());
    }
  }
  EXPECT_DOUBLE_EQ(rays.max_length(), longest);
}

TEST(PixelRays, a_pixel_without_a_ray_is_nan) {
  Camera camera = testkit::small_camera();
  camera.model = CameraModel::radtan;
  camera.distortion = {-1.5, 0, 0, 0};  // no ray is imaged further out than 0.31
  const PixelRays rays(camera);
  EXPECT_TRUE(std::isnan(rays.x_row(0)[0]));
  EXPECT_TRUE(std::isnan(rays.y_row(0)[0]));
  EXPECT_FALSE(std::isnan(rays.x_row(24)[32]));
  EXPECT_LT(rays.max_length(), 1.2);
}

TEST(PixelRays, need_pixels) {
  EXPECT_THROW(PixelRays(Camera{}), PreconditionError);
}

}  // namespace
}  // namespace cairn
