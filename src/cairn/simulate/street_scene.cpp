// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/street_scene.h"

#include <algorithm>
#include <cmath>

#include "cairn/simulate/street_painters.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Across the street, metres from the driven line, outwards positive.
constexpr double kOuterHouses = 6.5, kOuterKerb = 3.0, kOuterCars = 4.0, kOuterPoles = 5.4;
constexpr double kInnerHouses = -9.5, kInnerKerb = -6.0, kInnerCars = -6.9, kInnerPoles = -8.2;

/// One of the four sides of the block: a place on it is (along, outwards, up), metres, from the middle of the
/// driven side.
struct Side {
  Vector3d middle;
  Vector3d along;     ///< unit, the direction of driving
  Vector3d outwards;  ///< unit
  double half_length = 0;

  [[nodiscard]] Vector3d at(double distance, double out, double up = 0) const {
    return middle + distance * along + out * outwards + Vector3d(0, 0, up);
  }
  [[nodiscard]] double yaw() const { return std::atan2(along.y(), along.x()); }
};

std::vector<Side> sides_of(const Vector2d& half) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
  return {{-half.y() * y, x, -y, half.x()},
          {half.x() * x, y, x, half.y()},
          {half.y() * y, -x, y, half.x()},
          {-half.x() * x, -y, -x, half.y()}};
}

/// Ground in four pieces: the two along x reach over the corners, the two along y lie between them.
void add_ground(SceneBuilder& scene, const Vector2d& half) {
  constexpr double kUnderHouses = 1.5;
  const double out = kOuterHouses + kUnderHouses, in = kInnerHouses - kUnderHouses, width = out - in;
  const Vector2d outer = half + Vector2d(out, out), inner = half + Vector2d(in, in);
  StreetGround ground;
  ground.near_pavement = out - kOuterKerb;
  ground.far_pavement = kInnerKerb - in;
  for (const double side : {-1.0, 1.0}) {  // a canvas seen from above has +y on top
    ground.along_x = true;
    ground.near_first = side > 0;
    ground.corner = out - kInnerKerb;
    scene.add_floor({0, side * (outer.y() + inner.y()) / 2, 0}, 2 * outer.x(), width, 0,
                    street_ground(ground));
    ground.along_x = false;
    ground.near_first = side < 0;
    ground.corner = 0;
    scene.add_floor({side * (outer.x() + inner.x()) / 2, 0, 0}, width, 2 * inner.y(), 0,
                    street_ground(ground));
  }
}

/// A row of houses along a side from -reach to +reach, fronts at `out` or up to 1.2 m further away from the
/// street. `facing` is 1 for houses that look outwards (the inner ones), -1 for those that look inwards.
void add_houses(SceneBuilder& scene, const Side& side, double out, double reach, double facing,
                Random& random) {
  constexpr double kDepth = 7;
  for (double begin = -reach; begin < reach - 0.1;) {
    double width = random.uniform(6, 12);
    if (reach - begin - width < 5) width = reach - begin;  // no sliver at the end
    const double storeys = 3.0 * (2 + random.index(3)), height = storeys + random.uniform(0.3, 1.2);
    const double front = out - facing * random.uniform(0, 1.2), middle = begin + width / 2;
    scene.add_wall(side.at(middle, front), facing * side.outwards, width, height, house_front());
    const double deep = front - facing * kDepth / 2;
    scene.add_wall(side.at(begin, deep), -side.along, kDepth, height, brick_wall());
    scene.add_wall(side.at(begin + width, deep), side.along, kDepth, height, brick_wall());
    begin += width;
  }
}

void add_car(SceneBuilder& scene, const Side& side, double distance, double out, Random& random) {
  const double length = random.uniform(3.8, 4.6), yaw = side.yaw() + random.uniform(-0.04, 0.04);
  scene.add_box({side.at(distance, out, 0.2), {length, 1.7, 0.75}, yaw}, car_body());
  scene.add_box({side.at(distance - 0.2, out, 0.95), {0.55 * length, 1.5, 0.55}, yaw}, car_body());
}

void add_pole(SceneBuilder& scene, const Side& side, double distance, double out, Random& random) {
  const double yaw = side.yaw() + random.uniform(-0.5, 0.5), height = random.uniform(2.6, 5);
  scene.add_box({side.at(distance, out), {0.12, 0.12, height}, yaw}, pole());
  scene.add_box({side.at(distance, out, height - 0.7), {0.1, 0.7, 0.7}, yaw + 0.1}, pole());
}

void add_tree(SceneBuilder& scene, const Side& side, double distance, double out, Random& random) {
  const double yaw = random.uniform(0, 3), size = random.uniform(1.4, 2.0);
  scene.add_box({side.at(distance, out), {0.25, 0.25, 2.4}, yaw}, brick_wall());
  scene.add_box({side.at(distance, out, 2.4), {size, size, size}, yaw}, leaves());
  scene.add_box({side.at(distance, out, 2.4 + size), {0.7 * size, 0.7 * size, 0.6 * size}, yaw + 0.7},
                leaves());
}

/// Things on the pavement, every few metres, away from the corners that the drive rounds.
void add_furniture(SceneBuilder& scene, const Side& side, double cars, double poles, Random& random) {
  const double reach = side.half_length - 9;
  for (double at = -reach; at < reach; at += random.uniform(4.5, 8)) {
    switch (random.index(4)) {
      case 0:
        add_pole(scene, side, at, poles, random);
        break;
      case 1:
        add_tree(scene, side, at, poles, random);
        break;
      default:
        add_car(scene, side, at, cars, random);
    }
  }
}

}  // namespace

SceneBuilder street_around_block(const Vector2d& half_extent, double texel, std::uint64_t seed) {
  SceneBuilder scene(texel, seed);
  Random random(seed, 1ULL << 40);  // the layout's own stream, apart from those of the surfaces
  add_ground(scene, half_extent);
  for (const Side& side : sides_of(half_extent)) {
    add_houses(scene, side, kOuterHouses, side.half_length + kOuterHouses + 1.2, -1, random);
    add_houses(scene, side, kInnerHouses, side.half_length + kInnerHouses, 1, random);
    add_furniture(scene, side, kOuterCars, kOuterPoles, random);
    add_furniture(scene, side, kInnerCars, kInnerPoles, random);
  }
  return scene;
}

}  // namespace cairn
