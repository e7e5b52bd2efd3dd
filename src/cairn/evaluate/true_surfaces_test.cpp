// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/true_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera small_camera() {
  Camera camera;
  camera.width = 200;
  camera.height = 150;
  camera.fx = 180;
  camera.fy = 185;
  camera.cx = 99.5;
  camera.cy = 74.5;
  return camera;
}

Vector3d ray(const Camera& camera, double u, double v) {
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1};
}

/// Depth to the nearest of the planes whose region holds the pixel, stored as the simulator does.
template <class SeesPlane>
RawDepthImage render(const Camera& camera, const std::vector<Plane>& planes, const SeesPlane& sees) {
  RawDepthImage depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      double nearest = 0;
      for (std::size_t i = 0; i < planes.size(); ++i) {
        const double z = planes[i].distance / planes[i].normal.dot(ray(camera, u, v));
        if (sees(i, u, v) && z > 0 && (nearest == 0 || z < nearest)) nearest = z;
      }
      const double units = std::round(256 * nearest);
      depth(u, v) = units > 65535 ? 0 : static_cast<std::uint16_t>(units);
    }
  }
  return depth;
}

const Plane kWall{Vector3d(0.3, -0.1, 1).normalized(), 7};
const Plane kGround{Vector3d(0, 1, 0.02).normalized(), 1.6};

TEST(TrueSurfaces, FindsThePlaneToAMillimetre) {
  const Camera camera = small_camera();
  for (const Plane& plane : {kWall, Plane{{0, 0, 1}, 5.001}, Plane{Vector3d(1, 0.2, 1).normalized(), 3}}) {
    const RawDepthImage depth = render(camera, {plane}, [](auto...) { return true; });
    Random random(3);
    for (int i = 0; i < 200; ++i) {
      const Vector2d pixel(random.uniform(5, 190), random.uniform(5, 140));
      const auto found = find_surfaces(depth, camera, pixel);
      ASSERT_EQ(found.size(), 1U) << pixel.transpose();
      const Vector3d on_plane = ray(camera, pixel.x(), pixel.y()) *
                                (plane.distance / plane.normal.dot(ray(camera, pixel.x(), pixel.y())));
      EXPECT_LT(std::abs(found[0].behind(on_plane)), 0.002);  // half of 1/256 m if the depth is constant
      EXPECT_LT(std::abs(found[0].behind(1.02 * on_plane) - plane.behind(1.02 * on_plane)), 0.003);
      EXPECT_NEAR(found[0].normal.norm(), 1, 1e-12);
      EXPECT_GT(found[0].distance, 0);
    }
  }
}

/// The road at a slant: depths change by metres from row to row, its height is known to a millimetre.
TEST(TrueSurfaces, FindsARoad) {
  const Camera camera = small_camera();
  const RawDepthImage depth = render(camera, {kGround}, [](auto...) { return true; });
  for (const double v : {82.0, 90.3, 110.0}) {
    const auto found = find_surfaces(depth, camera, Vector2d(60.2, v));
    ASSERT_EQ(found.size(), 1U) << v;
    const Vector3d place =
        ray(camera, 60.2, v) * (kGround.distance / kGround.normal.dot(ray(camera, 60.2, v)));
    EXPECT_LT(std::abs(found[0].behind(place)), 0.001) << v;
    EXPECT_LT((found[0].normal - kGround.normal).norm(), 0.01) << v;
  }
}

TEST(TrueSurfaces, SeesBothSidesOfAnOutline) {
  const Camera camera = small_camera();
  const Plane front{{0, 0, 1}, 4};
  const RawDepthImage depth =
      render(camera, {kWall, front}, [](std::size_t i, int u, int) { return i == 0 || u < 100; });
  const auto at_edge =
      find_surfaces(depth, camera, Vector2d(98.2, 70));  // on the front, 1.8 px from the wall
  ASSERT_EQ(at_edge.size(), 2U);
  EXPECT_NEAR(at_edge[0].distance, 4, 0.002);
  EXPECT_NEAR(at_edge[1].distance, 7, 0.02);
  EXPECT_EQ(find_surfaces(depth, camera, Vector2d(95, 70)).size(), 1U);
  EXPECT_EQ(find_surfaces(depth, camera, Vector2d(104, 70)).size(), 1U);
}

TEST(TrueSurfaces, FindsNothingInTheSkyOrOutside) {
  const Camera camera = small_camera();
  const RawDepthImage depth = render(camera, {kWall}, [](std::size_t, int, int v) { return v > 70; });
  EXPECT_TRUE(find_surfaces(depth, camera, Vector2d(50, 60)).empty());
  EXPECT_EQ(find_surfaces(depth, camera, Vector2d(50, 69)).size(), 1U);  // 2 px beside the wall
  EXPECT_TRUE(find_surfaces(depth, camera, Vector2d(-5, 100)).empty());
  EXPECT_TRUE(find_surfaces(depth, camera, Vector2d(std::nan(""), 100)).empty());
  EXPECT_THROW((void)find_surfaces(depth, camera, Vector2d(50, 69), {.half_window = 1}), PreconditionError);
}

/// A pole of one column leaves its plane free to turn about the column.
TEST(TrueSurfaces, TakesNoPlaneOfOneColumn) {
  const Camera camera = small_camera();
  const RawDepthImage depth =
      render(camera, {Plane{{0, 0, 1}, 4}}, [](std::size_t, int u, int) { return u == 100; });
  EXPECT_TRUE(find_surfaces(depth, camera, Vector2d(100, 70)).empty());
}

}  // namespace
}  // namespace cairn
