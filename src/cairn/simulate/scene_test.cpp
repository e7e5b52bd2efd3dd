// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/simulate/scene_builder.h"

namespace cairn {
namespace {

Camera small_camera() {
  Camera camera;
  camera.width = 80;
  camera.height = 60;
  camera.fx = camera.fy = 65;
  camera.cx = 39.5;
  camera.cy = 29.5;
  return camera;
}

Painter plain(const Color& color) {
  return [color](Canvas& canvas, Random&) { canvas.fill(color); };
}

/// Looks along +y from the origin, z up.
Rigid3 looking_along_y() {
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d::UnitX();
  axes.col(1) = -Eigen::Vector3d::UnitZ();
  axes.col(2) = Eigen::Vector3d::UnitY();
  return {Eigen::Quaterniond(axes), {0, 0, 0}};
}

TEST(scene, wall_lies_at_its_depth_and_ends_at_its_borders) {
  SceneBuilder builder(0.05, 1);
  builder.add_wall({0, 2, -0.5}, -Eigen::Vector3d::UnitY(), 1.0, 1.0, plain({250, 120, 60}));
  const Camera camera = small_camera();
  const SceneImage image = render_scene(builder.build(Executor()), camera, looking_along_y());
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = 2 * (u - camera.cx) / camera.fx, y = 2 * (v - camera.cy) / camera.fy;
      const bool inside = std::abs(x) <= 0.5 && std::abs(y) <= 0.5;
      ASSERT_NEAR(image.depth(u, v), inside ? 2.0 : 0.0, 1e-6) << u << " " << v;
    }
  }
}

TEST(scene, slanted_floor_has_the_analytic_depth) {
  SceneBuilder builder(0.1, 1);
  builder.add_floor({0, 0, -1.5}, 200, 200, 0.3, plain({90, 90, 90}));
  const Camera camera = small_camera();
  const SceneImage image = render_scene(builder.build(Executor()), camera, looking_along_y());
  for (int v = 35; v < camera.height; ++v) {
    const double expected = 1.5 * camera.fy / (v - camera.cy);
    if (expected > 90) continue;
    ASSERT_NEAR(image.depth(40, v), expected, 1e-5 * expected);
  }
  EXPECT_EQ(image.depth(40, 10), 0.0F);  // sky
}

TEST(scene, nearer_surface_hides_the_further_and_backs_are_not_seen) {
  const Eigen::Vector3d to_camera = -Eigen::Vector3d::UnitY();
  SceneBuilder builder(0.05, 1);
  builder.add_wall({0, 2, -1}, to_camera, 2, 2, plain({200, 0, 0}));
  builder.add_wall({0, 4, -4}, to_camera, 8, 8, plain({0, 200, 0}));
  builder.add_wall({0, 1, -1}, -to_camera, 2, 2, plain({0, 0, 200}));  // seen from behind
  const SceneImage image = render_scene(builder.build(Executor()), small_camera(), looking_along_y());
  EXPECT_FLOAT_EQ(image.depth(40, 30), 2);
  EXPECT_FLOAT_EQ(image.depth(2, 2), 4);
  EXPECT_GT(image.light(40, 30)[0], 100);
  EXPECT_EQ(image.light(40, 30)[2], 0);
}

TEST(scene, surface_reaching_behind_the_camera_is_cut_rightly) {
  SceneBuilder builder(0.1, 1);
  builder.add_wall({1, 0, -2}, -Eigen::Vector3d::UnitX(), 40, 4, plain({120, 120, 120}));
  const Camera camera = small_camera();
  const SceneImage image = render_scene(builder.build(Executor()), camera, looking_along_y());
  const double expected = camera.fx / (79 - camera.cx);  // x = 1
  EXPECT_NEAR(image.depth(79, 30), expected, 1e-5);
  EXPECT_EQ(image.depth(0, 30), 0.0F);
}

TEST(scene, texture_lies_where_it_was_painted) {
  SceneBuilder builder(0.01, 1);
  builder.add_wall({0, 2, -1}, -Eigen::Vector3d::UnitY(), 3, 2, [](Canvas& canvas, Random&) {
    canvas.fill(Color::Zero());
    canvas.draw({{1.1, 0.7}, {0.1, 0.1}, 0, false, Color::Constant(250), 1});  // from the top left
  });
  Scene scene = builder.build(Executor());
  scene.background = Color::Zero();
  const Camera camera = small_camera();
  const SceneImage image = render_scene(scene, camera, looking_along_y());
  Eigen::Vector3d sum(0, 0, 0);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) sum += image.light(u, v)[0] * Eigen::Vector3d(u, v, 1);
  EXPECT_NEAR(sum.x() / sum.z(), camera.cx + camera.fx * (1.1 - 1.5) / 2, 0.05);
  EXPECT_NEAR(sum.y() / sum.z(), camera.cy + camera.fy * (0.7 - 1.0) / 2, 0.05);
}

TEST(scene, borders_between_surfaces_are_antialiased) {
  SceneBuilder builder(0.05, 1);
  builder.add_wall({-1.01, 2, -2}, -Eigen::Vector3d::UnitY(), 2, 4, plain({200, 200, 200}));
  Scene scene = builder.build(Executor());
  scene.background = Color::Zero();
  const SceneImage image = render_scene(scene, small_camera(), looking_along_y());
  const float bright = image.light(20, 30)[0], border = image.light(39, 30)[0];
  EXPECT_GT(bright, 100);
  EXPECT_GT(border, 0.2F * bright);
  EXPECT_LT(border, 0.8F * bright);
  EXPECT_EQ(image.light(45, 30)[0], 0);
}

TEST(scene, box_shows_all_its_sides_outwards) {
  SceneBuilder builder(0.05, 1);
  builder.add_box({{0, 3, -0.5}, {1, 1, 1}, 0.6}, plain({150, 150, 150}));
  const Scene scene = builder.build(Executor());
  ASSERT_EQ(scene.surfaces.size(), 5U);
  for (const Surface& s : scene.surfaces) {
    const Eigen::Vector3d middle = s.corner + s.width / 2 * s.right + s.height / 2 * s.down;
    const Eigen::Vector3d outwards = middle - Eigen::Vector3d(0, 3, 0);
    EXPECT_LT(s.right.cross(s.down).dot(outwards), -0.4);  // that axis points away from the viewer
    EXPECT_NEAR(outwards.norm(), 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace cairn
