// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/scene_builder.h"

#include <cmath>
#include <utility>

namespace cairn {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// The light comes from above and a little from one side, so that the sides of a box differ.
float brightness_of(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d towards_light = Eigen::Vector3d(0.5, 0.25, 0.83).normalized();
  return static_cast<float>(0.82 + 0.18 * normal.dot(towards_light));
}

Eigen::Vector3d turned_x(double yaw) {
  return {std::cos(yaw), std::sin(yaw), 0};
}

Eigen::Vector3d turned_y(double yaw) {
  return {-std::sin(yaw), std::cos(yaw), 0};
}

}  // namespace

void SceneBuilder::add(const Surface& surface, float brightness, const Painter& paint) {
  jobs_.push_back({surface, brightness, paint});
  jobs_.back().surface.texture = static_cast<int>(jobs_.size()) - 1;
}

void SceneBuilder::add_wall(const Eigen::Vector3d& bottom, const Eigen::Vector3d& normal, double width,
                            double height, const Painter& paint) {
  const Eigen::Vector3d right = kUp.cross(normal);
  add({bottom + height * kUp - width / 2 * right, right, -kUp, width, height}, brightness_of(normal), paint);
}

void SceneBuilder::add_floor(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                             const Painter& paint) {
  const Eigen::Vector3d x = turned_x(yaw), y = turned_y(yaw);
  add({center - size_x / 2 * x + size_y / 2 * y, x, -y, size_x, size_y}, brightness_of(kUp), paint);
}

void SceneBuilder::add_ceiling(const Eigen::Vector3d& center, double size_x, double size_y, double yaw,
                               const Painter& paint) {
  const Eigen::Vector3d x = turned_x(yaw), y = turned_y(yaw);
  add({center - size_x / 2 * x - size_y / 2 * y, x, y, size_x, size_y}, brightness_of(-kUp), paint);
}

void SceneBuilder::add_box(const Box& box, const Painter& paint_sides, const Painter& paint_top) {
  const Eigen::Vector3d x = turned_x(box.yaw), y = turned_y(box.yaw);
  const Eigen::Vector3d half = box.size / 2;
  add_wall(box.bottom + half.x() * x, x, box.size.y(), box.size.z(), paint_sides);
  add_wall(box.bottom - half.x() * x, -x, box.size.y(), box.size.z(), paint_sides);
  add_wall(box.bottom + half.y() * y, y, box.size.x(), box.size.z(), paint_sides);
  add_wall(box.bottom - half.y() * y, -y, box.size.x(), box.size.z(), paint_sides);
  add_floor(box.bottom + box.size.z() * kUp, box.size.x(), box.size.y(), box.yaw, paint_top);
  if (box.bottom.z() > 0) add_ceiling(box.bottom, box.size.x(), box.size.y(), box.yaw, paint_top);
}

Scene SceneBuilder::build(const Executor& executor) const {
  std::vector<Canvas> painted(jobs_.size());
  executor.for_each(jobs_.size(), [&](std::size_t i) {
    const Job& job = jobs_[i];
    painted[i] = Canvas(job.surface.width, job.surface.height, texel_, Color::Constant(128));
    Random random(seed_, i);
    job.paint(painted[i], random);
    painted[i].scale(job.brightness);
  });
  Scene scene;
  for (const Job& job : jobs_) scene.surfaces.push_back(job.surface);
  for (Canvas& canvas : painted) scene.textures.emplace_back(std::move(canvas).take());
  return scene;
}

}  // namespace cairn
