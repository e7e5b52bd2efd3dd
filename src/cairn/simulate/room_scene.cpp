// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/room_scene.h"

#include <cmath>

#include "cairn/simulate/painters.h"

namespace cairn {
namespace {

const Color kOak{170, 124, 80}, kWalnut{104, 70, 46}, kBeech{206, 166, 118}, kLacquer{226, 224, 218};

void add_shell(SceneBuilder& scene) {
  const double x = kRoomSize.x(), y = kRoomSize.y(), z = kRoomSize.z();
  const Eigen::Vector3d to_right = Eigen::Vector3d::UnitX(), to_back = Eigen::Vector3d::UnitY();
  scene.add_wall({0, y / 2, 0}, to_right, y, z, wallpaper({222, 200, 166}, 4));
  scene.add_wall({x, y / 2, 0}, -to_right, y, z, wallpaper({168, 190, 196}, 4));
  scene.add_wall({x / 2, 0, 0}, to_back, x, z, wallpaper({186, 202, 164}, 5));
  scene.add_wall({x / 2, y, 0}, -to_back, x, z, wallpaper({208, 170, 150}, 5));
  scene.add_floor({x / 2, y / 2, 0}, x, y, 0, floor_boards({2.4, 1.7}));
  scene.add_ceiling({x / 2, y / 2, z}, x, y, 0, ceiling_tiles());
}

/// A board on four legs.
void add_table(SceneBuilder& scene, const Box& outline, const Color& color) {
  constexpr double kBoard = 0.04, kLeg = 0.05;
  const double c = std::cos(outline.yaw), s = std::sin(outline.yaw), under = outline.size.z() - kBoard;
  for (const double side_x : {-0.5, 0.5}) {
    for (const double side_y : {-0.5, 0.5}) {
      const double x = side_x * (outline.size.x() - 2 * kLeg), y = side_y * (outline.size.y() - 2 * kLeg);
      const Eigen::Vector3d foot = outline.bottom + Eigen::Vector3d(c * x - s * y, s * x + c * y, 0);
      scene.add_box({foot, {kLeg, kLeg, under}, outline.yaw}, wood(color));
    }
  }
  const Eigen::Vector3d board = outline.bottom + Eigen::Vector3d(0, 0, under);
  scene.add_box({board, {outline.size.x(), outline.size.y(), kBoard}, outline.yaw}, wood(color));
}

void add_desk(SceneBuilder& scene) {
  add_table(scene, {{0.45, 1.6, 0}, {0.75, 1.5, 0.74}, 0}, kBeech);
  scene.add_box({{0.22, 1.6, 0.84}, {0.05, 0.56, 0.36}, 0.05}, fabric({52, 58, 74}));
  scene.add_box({{0.22, 1.6, 0.74}, {0.16, 0.22, 0.1}, 0.05}, wood({60, 60, 64}));
  scene.add_box({{0.48, 1.05, 0.74}, {0.22, 0.3, 0.12}, 0.3}, carton());
  scene.add_box({{0.5, 2.12, 0.74}, {0.2, 0.27, 0.06}, -0.2}, fabric({186, 72, 58}));
  scene.add_box({{0.5, 2.12, 0.80}, {0.18, 0.24, 0.05}, 0.15}, fabric({64, 104, 158}));
}

void add_sofa(SceneBuilder& scene) {
  const Color green{92, 122, 96};
  scene.add_box({{3.2, 4.55, 0}, {1.9, 0.8, 0.42}, 0}, fabric(green));
  scene.add_box({{3.2, 4.88, 0.42}, {1.9, 0.2, 0.45}, 0}, fabric(green));
  scene.add_box({{2.2, 4.55, 0}, {0.18, 0.8, 0.6}, 0}, fabric(green));
  scene.add_box({{4.2, 4.55, 0}, {0.18, 0.8, 0.6}, 0}, fabric(green));
  scene.add_box({{2.7, 4.66, 0.42}, {0.42, 0.16, 0.36}, 0.2}, fabric({214, 150, 70}));
  scene.add_box({{3.75, 4.64, 0.42}, {0.40, 0.16, 0.34}, -0.15}, fabric({150, 76, 110}));
}

void add_storage(SceneBuilder& scene) {
  scene.add_box({{0.32, 3.9, 0}, {0.6, 1.3, 2.05}, 0}, wood(kOak));
  scene.add_box({{5.8, 3.2, 0}, {0.36, 1.5, 1.95}, 0}, book_shelf(), wood(kWalnut));
  scene.add_box({{5.75, 1.2, 0}, {0.46, 1.3, 0.8}, 0}, wood(kLacquer));
  scene.add_box({{5.72, 0.85, 0.8}, {0.3, 0.36, 0.3}, 0.3}, carton());
  scene.add_box({{5.74, 1.5, 0.8}, {0.2, 0.2, 0.42}, -0.4}, fabric({84, 128, 168}));
}

void add_cartons(SceneBuilder& scene) {
  scene.add_box({{4.6, 0.45, 0}, {0.6, 0.5, 0.45}, 0.25}, carton());
  scene.add_box({{4.55, 0.42, 0.45}, {0.45, 0.4, 0.35}, -0.2}, carton());
  scene.add_box({{3.9, 0.4, 0}, {0.5, 0.42, 0.38}, -0.35}, carton());
  scene.add_box({{5.2, 4.4, 0}, {0.55, 0.55, 0.5}, 0.6}, carton());
  scene.add_box({{5.22, 4.42, 0.5}, {0.4, 0.36, 0.3}, 0.1}, carton());
}

void add_corner(SceneBuilder& scene) {
  add_table(scene, {{2.2, 0.5, 0}, {1.1, 0.65, 0.62}, 0.08}, kWalnut);
  scene.add_box({{2.0, 0.5, 0.62}, {0.3, 0.24, 0.22}, 0.5}, fabric({200, 184, 88}));
  scene.add_box({{2.45, 0.45, 0.62}, {0.26, 0.2, 0.34}, -0.3}, book_shelf());
  scene.add_box({{0.5, 0.5, 0}, {0.3, 0.3, 0.03}, 0.4}, wood(kWalnut));  // a lamp
  scene.add_box({{0.5, 0.5, 0.03}, {0.05, 0.05, 1.4}, 0.4}, wood(kWalnut));
  scene.add_box({{0.5, 0.5, 1.43}, {0.36, 0.36, 0.3}, 0.4}, fabric({232, 208, 160}));
  scene.add_box({{3.1, 0.09, 1.35}, {0.9, 0.18, 0.03}, 0}, wood(kOak));  // a shelf on the wall
  scene.add_box({{3.0, 0.1, 1.38}, {0.5, 0.14, 0.24}, 0}, book_shelf());
}

}  // namespace

SceneBuilder furnished_room(double texel, std::uint64_t seed) {
  SceneBuilder scene(texel, seed);
  add_shell(scene);
  add_desk(scene);
  add_sofa(scene);
  add_storage(scene);
  add_cartons(scene);
  add_corner(scene);
  return scene;
}

}  // namespace cairn
