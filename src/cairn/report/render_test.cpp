// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/report/overview.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

constexpr float kStep = 0.02F;

/// A room 4 x 3 x 2.4 m: blue floor at z = 0, grey walls, white ceiling.
Cloud room() {
  Cloud cloud;
  const auto span = [](float length) { return static_cast<int>(length / kStep); };
  for (int i = 0; i <= span(4); ++i) {
    for (int j = 0; j <= span(3); ++j) {
      cloud.points.push_back({kStep * static_cast<float>(i), kStep * static_cast<float>(j), 0, 20, 40, 200});
      cloud.points.push_back(
          {kStep * static_cast<float>(i), kStep * static_cast<float>(j), 2.4F, 255, 255, 255});
    }
  }
  for (int k = 0; k <= span(2.4F); ++k) {
    const float z = kStep * static_cast<float>(k);
    for (int i = 0; i <= span(4); ++i) {
      cloud.points.push_back({kStep * static_cast<float>(i), 0, z, 120, 120, 120});
      cloud.points.push_back({kStep * static_cast<float>(i), 3, z, 120, 120, 120});
    }
    for (int j = 0; j <= span(3); ++j) {
      cloud.points.push_back({0, kStep * static_cast<float>(j), z, 120, 120, 120});
      cloud.points.push_back({4, kStep * static_cast<float>(j), z, 120, 120, 120});
    }
  }
  return cloud;
}

/// A camera turning in the middle of the room, looking level, a little down and a little up.
CameraPath turning_path() {
  CameraPath path;
  for (int i = 0; i < 72; ++i) {
    const double azimuth = i * 0.349, pitch = 0.5 * std::sin(1.0 * i);
    const Eigen::Vector3d forward(std::cos(pitch) * std::cos(azimuth), std::cos(pitch) * std::sin(azimuth),
                                  std::sin(pitch));
    Eigen::Matrix3d rotation;
    rotation.col(2) = forward;
    rotation.col(0) = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    rotation.col(1) = forward.cross(rotation.col(0));
    path.world_from_camera.push_back({Eigen::Quaterniond(rotation), {2 + 0.1 * std::cos(azimuth), 1.5, 1.3}});
  }
  path.keyframes = {0, 24, 48};
  return path;
}

RenderCamera looking_at_wall(double distance) {
  return {testkit::small_camera(), {Eigen::Quaterniond::Identity(), {0, 0, -distance}}};
}

Cloud red_wall() {
  Cloud cloud;
  for (int i = -100; i <= 100; ++i)
    for (int j = -100; j <= 100; ++j)
      cloud.points.push_back({0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), 0, 200, 0, 0});
  return cloud;
}

TEST(Render, AWallFillsThePictureWithoutHoles) {
  const RgbImage picture = render_cloud(red_wall(), looking_at_wall(0.8));
  EXPECT_GT(picture.size(), 0U);
  for (std::size_t i = 0; i < picture.size(); ++i) EXPECT_EQ(picture.data()[i], (Rgb8{200, 0, 0})) << i;
}

TEST(Render, TheNearestPointWins) {
  Cloud cloud = red_wall();
  cloud.points.push_back({0, 0, -0.2F, 0, 250, 0});
  cloud.points.push_back({0, 0, 0.2F, 0, 0, 250});
  RenderOptions options;
  options.point_size = 0.2;
  EXPECT_EQ(render_cloud(cloud, looking_at_wall(0.8), options)(31, 23), (Rgb8{0, 250, 0}));
}

TEST(Render, WhereNothingIsTheBackgroundIs) {
  const RenderOptions options;
  const RgbImage picture = render_cloud({}, looking_at_wall(1), options);
  EXPECT_EQ(picture(5, 0), options.background_top);
  EXPECT_EQ(picture(5, 47), options.background_bottom);
}

TEST(Render, AnEdgeInDepthIsDarkened) {
  Cloud cloud = red_wall();
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j)
      cloud.points.push_back(
          {0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j), -0.3F, 200, 0, 0});
  const RgbImage picture = render_cloud(cloud, looking_at_wall(1.0));
  EXPECT_EQ(picture(31, 23).r, 200);
  int darkest = 255;
  for (int u = 0; u < 64; ++u) darkest = std::min<int>(darkest, picture(u, 23).r);
  EXPECT_LT(darkest, 160);
}

TEST(Render, WhatFacesAwayIsLeftOutWithASurface) {
  const Cloud wall = red_wall();
  const Rigid3 behind{rotation_exp({0, 3.14159265358979, 0}), {0, 0, 1}};  // looks at the wall from z = 1
  const CloudSurface surface(wall, {behind}, 0.05);
  EXPECT_GT(render_cloud(wall, looking_at_wall(0.8), {}, &surface)(31, 23).b, 200);  // background
  const CloudSurface seen_from_here(wall, {looking_at_wall(1).world_from_camera}, 0.05);
  EXPECT_EQ(render_cloud(wall, looking_at_wall(0.8), {}, &seen_from_here)(31, 23).r, 200);
}

TEST(Surface, NormalsOfAPlanePointAtTheCamera) {
  const CloudSurface surface(red_wall(), {looking_at_wall(2).world_from_camera}, 0.05);
  EXPECT_FALSE(surface.cells().empty());
  for (const SurfaceCell& cell : surface.cells()) {
    EXPECT_TRUE(cell.seen || cell.centre.norm() > 1);
    EXPECT_NEAR(std::abs(cell.normal.z()), 1, 1e-4);
    EXPECT_GT(cell.flatness, 0.99F);
    EXPECT_TRUE(!cell.seen || cell.normal.z() < 0);
  }
}

TEST(Overview, UpIsTheNormalOfTheFloor) {
  const CameraPath path = turning_path();
  const CloudSurface surface(room(), path.world_from_camera, 0.1);
  EXPECT_GT(estimate_up(surface, path.world_from_camera).z(), std::cos(0.5 * 3.14159 / 180));
}

TEST(Overview, LooksIntoTheRoomFromAbove) {
  const CameraPath path = turning_path();
  const Cloud cloud = room();
  const CloudSurface surface(cloud, path.world_from_camera, 0.1);
  const RenderCamera view = overview_of(surface, path.world_from_camera, 320, 200);
  EXPECT_GT(view.world_from_camera.translation.z(), 2.4);
  const RgbImage picture = draw_overview(cloud, path, static_cast<double>(kStep), 320, 200);
  int floor = 0, ceiling = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const Rgb8& p = picture.data()[i];
    floor += p.b > 120 && p.r < 60 ? 1 : 0;
    ceiling += p == Rgb8{255, 255, 255} ? 1 : 0;
  }
  EXPECT_GT(floor, 6000);    // the ceiling faces away and is left out
  EXPECT_LT(ceiling, 1000);  // the path's halo
}

TEST(Overview, NothingToSeeIsAnEmptyPicture) {
  const RgbImage picture = draw_overview({}, {}, 0.01, 40, 30);
  EXPECT_EQ(picture(3, 0), RenderOptions{}.background_top);
}

TEST(Render, PicturesAreTheSameEachTime) {
  const CameraPath path = turning_path();
  EXPECT_EQ(draw_overview(room(), path, 0.02, 160, 100), draw_overview(room(), path, 0.02, 160, 100));
}

TEST(Render, RefusesAViewWithDistortion) {
  RenderCamera view = looking_at_wall(1);
  view.camera.model = CameraModel::radtan;
  EXPECT_THROW((void)render_cloud({}, view), PreconditionError);
}

}  // namespace
}  // namespace cairn
