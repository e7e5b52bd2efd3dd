// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/geometry/random_points.h"

#include <cmath>
#include <limits>

namespace cairn::testkit {

// Braces keep the order in which elements are drawn; parentheses would leave it to the compiler.

Eigen::Vector3d normal_vector(Random& random, double sigma) {
  const Eigen::Vector3d unit{random.normal(), random.normal(), random.normal()};
  return sigma * unit;
}

Eigen::Vector3d point_in_box(Random& random, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  return {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()),
          random.uniform(low.z(), high.z())};
}

std::vector<Eigen::Vector3d> points_in_box(Random& random, std::size_t count, const Eigen::Vector3d& low,
                                           const Eigen::Vector3d& high) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(point_in_box(random, low, high));
  return points;
}

Rigid3 small_motion(Random& random, double radians, double metres) {
  return {rotation_exp(normal_vector(random, radians)), normal_vector(random, metres)};
}

bool SimulatedCamera::shows(const Eigen::Vector3d& pixels) const {
  return pixels.x() >= 0 && pixels.x() <= width - 1 && pixels.y() >= 0 && pixels.y() <= height - 1;
}

Eigen::Vector3d SimulatedCamera::point_in_view(Random& random, double nearest, double farthest) const {
  const Eigen::Vector3d seen =
      point_in_box(random, {0, 0, nearest}, {width - 1.0, height - 1.0, farthest});  // u, v, depth
  return rig.point_at(seen.x(), seen.y(), seen.z());
}

Observation observe(Random& random, const Eigen::Vector3d& exact, const PixelNoise& noise,
                    bool with_disparity) {
  Observation seen;
  seen.sigma_px = noise.sigma_px;
  seen.sigma_d_px = noise.sigma_d_px;
  seen.u = exact.x() + noise.scale * noise.sigma_px * random.normal();
  seen.v = exact.y() + noise.scale * noise.sigma_px * random.normal();
  if (with_disparity) seen.d = exact.z() + noise.scale * noise.sigma_d_px * random.normal();
  return seen;
}

void forget_disparity(Observation& seen) {
  seen = without_disparity(seen);
}

void mislead(Random& random, double aside_px, Observation& seen) {
  const double angle = random.uniform(0, 6.283), aside = aside_px * random.uniform(1, 3);
  seen.u += aside * std::cos(angle);
  seen.v += aside * std::sin(angle);
  if (seen.has_disparity()) seen.d = random.uniform(1, 60);
}

}  // namespace cairn::testkit
