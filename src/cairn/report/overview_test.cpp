// SPDX-License-Identifier: Apache-2.0
// What an overview of a furnished room shows is tested in render_test.cpp.
#include "cairn/report/overview.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cairn {
namespace {

/// Returns a floor of 4 x 2 m that rises by `slope` along x.
Cloud floor(double slope) {
  Cloud cloud;
  for (int i = 0; i <= 200; ++i)
    for (int j = 0; j <= 100; ++j)
      cloud.points.push_back({0.02F * static_cast<float>(i), 0.02F * static_cast<float>(j),
                              static_cast<float>(slope * 0.02 * i), 200, 50, 50});
  return cloud;
}

/// Returns a level camera, 1.5 m above the floor, that looks along y.
std::vector<Rigid3> level_path() {
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return {{Eigen::Quaterniond(rotation), {2, -1, 1.5}}};
}

TEST(Overview, up_is_z_without_a_path) {
  EXPECT_EQ(estimate_up(CloudSurface({}, {}, 0.1), {}), Eigen::Vector3d::UnitZ());
}

TEST(Overview, up_is_the_cameras_if_nothing_is_flat) {
  const Rigid3 upside_down{rotation_exp({0, 0, std::numbers::pi}), {0, 0, 0}};
  const CloudSurface nothing({}, {}, 0.1);
  EXPECT_NEAR(estimate_up(nothing, {Rigid3{}})[1], -1, 1e-12);
  EXPECT_NEAR(estimate_up(nothing, {upside_down})[1], 1, 1e-12);
}

TEST(Overview, up_is_drawn_to_the_floor_near_it) {
  const double slope = 0.2;
  const CloudSurface surface(floor(slope), level_path(), 0.1);
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope, 0, 1).normalized();
  EXPECT_GT(estimate_up(surface, level_path()).dot(normal), std::cos(0.01));
}

TEST(Overview, a_wall_does_not_change_what_is_up) {
  Cloud wall;
  for (const CloudPoint& p : floor(0).points) wall.points.push_back({p.x, 3, p.y, 9, 9, 9});
  const CloudSurface surface(wall, level_path(), 0.1);
  EXPECT_GT(estimate_up(surface, level_path()).z(), 0.9999);
}

TEST(Overview, shows_the_cloud_and_the_whole_path_from_above) {
  const Cloud cloud = floor(0);
  const RenderCamera view = overview_of(CloudSurface(cloud, level_path(), 0.1), level_path(), 320, 200);
  EXPECT_GT(view.world_from_camera.translation.z(), 1);
  const auto pixel_of = [&](const Eigen::Vector3d& point) {
    return view.camera.project(view.world_from_camera.inverse() * point).value_or(Eigen::Vector2d(-1, -1));
  };
  const auto shows = [](const Eigen::Vector2d& pixel) {
    return pixel.x() > 0 && pixel.x() < 319 && pixel.y() > 0 && pixel.y() < 199;
  };
  EXPECT_TRUE(shows(pixel_of(level_path()[0].translation)));
  std::size_t in_view = 0;
  double left = 320, right = 0;
  for (const CloudPoint& p : cloud.points) {
    const Eigen::Vector2d pixel = pixel_of({p.x, p.y, p.z});
    in_view += shows(pixel) ? 1 : 0;
    left = std::min(left, pixel.x());
    right = std::max(right, pixel.x());
  }
  EXPECT_GT(in_view, cloud.points.size() * 98 / 100) << "half a percent may stray over each border";
  EXPECT_GT(right - left, 100) << "and not from afar";
}

TEST(Overview, of_nothing_is_a_picture_of_its_size) {
  const RgbImage picture = draw_overview({}, {}, 0.01, 64, 40);
  EXPECT_EQ(picture.width(), 64);
  EXPECT_EQ(picture.height(), 40);
}

}  // namespace
}  // namespace cairn
