// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/surface.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn {
namespace {

/// Returns random points of the plane through the origin whose normal is `normal`, up to a metre away.
Cloud plane(const Eigen::Vector3d& normal) {
  Random random(3);
  const Eigen::Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i) {
    const double along_a = random.uniform(-1, 1), along_b = random.uniform(-1, 1);
    const Eigen::Vector3f point = (along_a * a + along_b * b).cast<float>();
    cloud.points.push_back({point.x(), point.y(), point.z()});
  }
  return cloud;
}

TEST(CloudSurface, normals_are_those_of_the_plane_and_point_at_the_camera) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  const Rigid3 behind{rotation_exp({0, 3.14159265358979, 0}), {0, 0, 3}};
  for (const Rigid3& world_from_camera : {Rigid3{Eigen::Quaterniond::Identity(), {0, 0, -3}}, behind}) {
    const CloudSurface surface(plane(normal), {world_from_camera}, 0.1);
    const double sign = world_from_camera.translation.z() < 0 ? 1 : -1;
    for (const SurfaceCell& cell : surface.cells()) {
      EXPECT_TRUE(cell.seen);
      EXPECT_GT(sign * normal.dot(cell.normal.cast<double>()), 0.9999);
      EXPECT_GT(cell.flatness, 0.99F);
    }
  }
}

TEST(CloudSurface, a_ball_is_not_flat) {
  Random random(4);
  Cloud cloud;
  while (cloud.points.size() < 2000) {
    const Eigen::Vector3d p = testkit::point_in_box(random, {0, 0, 0}, {0.2, 0.2, 0.2});
    if ((p.array() - 0.1).matrix().norm() < 0.1)
      cloud.points.push_back(
          {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  const CloudSurface surface(cloud, {}, 1.0);
  ASSERT_EQ(surface.cells().size(), 1U);
  EXPECT_LT(surface.cells()[0].flatness, 0.3F);
}

TEST(CloudSurface, what_no_camera_looked_at_is_not_seen) {
  const Rigid3 looks_away{Eigen::Quaterniond::Identity(), {0, 0, 3}};
  for (const std::vector<Rigid3>& path : {std::vector<Rigid3>{}, {looks_away}}) {
    const CloudSurface surface(plane({0, 0, 1}), path, 0.1);
    ASSERT_FALSE(surface.cells().empty());
    for (const SurfaceCell& cell : surface.cells()) EXPECT_FALSE(cell.seen);
  }
}

TEST(CloudSurface, the_cell_of_a_point_holds_it) {
  const Cloud cloud{{{0.05F, 0, 0}, {0.15F, 0, 0}, {-0.05F, 0, 0}, {0.07F, 0.02F, 0}}};
  const CloudSurface surface(cloud, {}, 0.1);
  EXPECT_EQ(surface.cells().size(), 3U);
  EXPECT_EQ(&surface.cell_of_point(0), &surface.cell_of_point(3));
  EXPECT_TRUE(surface.cell_of_point(0).centre.isApprox(Eigen::Vector3f(0.06F, 0.01F, 0)));
  EXPECT_EQ(surface.cell_of_point(2).centre.x(), -0.05F);
}

TEST(CloudSurface, cells_have_a_size) {
  EXPECT_THROW(CloudSurface(Cloud{}, {}, 0), PreconditionError);
}

}  // namespace
}  // namespace cairn
