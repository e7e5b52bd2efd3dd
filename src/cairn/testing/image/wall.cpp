// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/image/wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace cairn::testkit {

double wall_level(double x, double y) {
  return 128 + 40 * std::sin(3 * x + 1.5 * y) + 35 * std::cos(4 * y - 2 * x + 0.5) +
         30 * std::sin(5 * x - 0.3);
}

GrayImage see_wall(const Camera& camera, const Rigid3& world_from_camera) {
  constexpr double kDistance = 3;
  GrayImage image(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto ray = camera.unproject(Eigen::Vector2d(u, v));
      if (!ray) continue;
      const Eigen::Vector3d direction = world_from_camera.rotation * ray->homogeneous();
      const Eigen::Vector3d& centre = world_from_camera.translation;
      const Eigen::Vector3d point = centre + direction * ((kDistance - centre.z()) / direction.z());
      if (direction.z() > 0)
        image(u, v) = static_cast<std::uint8_t>(std::lround(wall_level(point.x(), point.y())));
    }
  }
  return image;
}

int largest_difference(const GrayImage& a, const GrayImage& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a.data()[i] - b.data()[i]));
  return largest;
}

}  // namespace cairn::testkit
