// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/two_view_scene.h"

#include <Eigen/Geometry>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

namespace {

Eigen::Vector3d vector_in_cube(Random& random, double half_side) {
  return point_in_box(random, Eigen::Vector3d::Constant(-half_side), Eigen::Vector3d::Constant(half_side));
}

Eigen::Vector2d ray_in_view(Random& random) {
  return {random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.45)};
}

Eigen::Vector2d noise(Random& random, double sigma) {
  return {sigma * random.normal(), sigma * random.normal()};
}

}  // namespace

TwoViewScene make_two_view_scene(std::uint64_t seed, int count, int outliers, double sigma, double baseline,
                                 SceneShape shape) {
  Random random(seed);
  TwoViewScene scene;
  scene.b_from_a.rotation = rotation_exp(vector_in_cube(random, 0.17));
  scene.b_from_a.translation = baseline * vector_in_cube(random, 1).normalized();
  while (static_cast<int>(scene.a.size()) < count) {
    const Eigen::Vector2d ray = ray_in_view(random);
    const double depth =
        shape == SceneShape::plane ? 3.0 / (1.0 + 0.5 * ray.x() - 0.3 * ray.y()) : random.uniform(2, 6);
    const Eigen::Vector3d in_a = depth * ray.homogeneous(), in_b = scene.b_from_a * in_a;
    Eigen::Vector2d b = in_b.hnormalized();
    if (in_b.z() < 0.5 || b.cwiseAbs().maxCoeff() > 1) continue;
    if (static_cast<int>(scene.a.size()) < outliers) b = ray_in_view(random);
    scene.points_in_a.push_back(in_a);
    scene.a.emplace_back(ray + noise(random, sigma));
    scene.b.emplace_back(b + noise(random, sigma));
  }
  return scene;
}

}  // namespace cairn::testkit
