// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Two views of simulated points.
struct TwoViewScene {
  Rigid3 b_from_a;
  std::vector<Eigen::Vector3d> points_in_a;
  std::vector<Eigen::Vector2d> a, b;  ///< (x/z, y/z)
};

enum class SceneShape { volume, plane };

/// A camera of about 60 degrees that turns by up to 0.3 rad and moves by `baseline`; points 2 to 6 away, with
/// Gaussian noise of `sigma` in both views; the first `outliers` of them anywhere in b.
inline TwoViewScene make_two_view_scene(std::uint64_t seed, int count, int outliers = 0, double sigma = 0,
                                        double baseline = 0.5, SceneShape shape = SceneShape::volume) {
  Random random(seed);
  const auto vector = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size),
                           random.uniform(-size, size));
  };
  TwoViewScene scene;
  scene.b_from_a = {rotation_exp(vector(0.17)), baseline * vector(1).normalized()};
  while (static_cast<int>(scene.a.size()) < count) {
    const Eigen::Vector2d ray(random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.45));
    const double depth =
        shape == SceneShape::plane ? 3.0 / (1.0 + 0.5 * ray.x() - 0.3 * ray.y()) : random.uniform(2, 6);
    const Eigen::Vector3d in_a = depth * ray.homogeneous(), in_b = scene.b_from_a * in_a;
    Eigen::Vector2d b = in_b.hnormalized();
    if (in_b.z() < 0.5 || b.cwiseAbs().maxCoeff() > 1) continue;
    if (static_cast<int>(scene.a.size()) < outliers)
      b = {random.uniform(-0.6, 0.6), random.uniform(-0.45, 0.45)};
    const auto noise = [&] { return Eigen::Vector2d(sigma * random.normal(), sigma * random.normal()); };
    scene.points_in_a.push_back(in_a);
    scene.a.emplace_back(ray + noise());
    scene.b.emplace_back(b + noise());
  }
  return scene;
}

}  // namespace cairn
