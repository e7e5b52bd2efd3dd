// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/p3p.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

using Points = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d random_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

struct Scene {
  Rigid3 camera_from_world;
  Points points_in_world, rays;
};

/// Three points 1 to 8 m ahead of a camera with a random pose.
Scene random_scene(Random& random) {
  Scene scene;
  scene.camera_from_world = {rotation_exp(random_vector(random, 2.0)), random_vector(random, 3.0)};
  const Rigid3 world_from_camera = scene.camera_from_world.inverse();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d in_camera =
        Eigen::Vector3d(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1.0) * random.uniform(1.0, 8.0);
    scene.points_in_world[i] = world_from_camera * in_camera;
    scene.rays[i] = in_camera.normalized();
  }
  return scene;
}

double pose_difference(const Rigid3& a, const Rigid3& b) {
  return motion_norm(a * b.inverse());
}

double best_difference(const P3pSolutions& solutions, const Rigid3& truth) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < solutions.count; ++i) {
    best = std::min(best, pose_difference(solutions.camera_from_world[i], truth));
  }
  return best;
}

TEST(P3p, finds_the_pose_of_random_scenes) {
  Random random(20);
  int found = 0;
  constexpr int kScenes = 5000;
  for (int i = 0; i < kScenes; ++i) {
    const Scene scene = random_scene(random);
    found +=
        best_difference(solve_p3p(scene.points_in_world, scene.rays), scene.camera_from_world) < 1e-6 ? 1 : 0;
  }
  EXPECT_GE(found, kScenes * 0.998);  // the rest is near a double root, where digits are lost
}

TEST(P3p, every_solution_sees_the_points_along_the_rays) {
  Random random(21);
  std::size_t count = 0;
  for (int i = 0; i < 1000; ++i) {
    const Scene scene = random_scene(random);
    const P3pSolutions solutions = solve_p3p(scene.points_in_world, scene.rays);
    count += solutions.count;
    for (std::size_t s = 0; s < solutions.count; ++s) {
      for (std::size_t p = 0; p < 3; ++p) {
        const Eigen::Vector3d ray = (solutions.camera_from_world[s] * scene.points_in_world[p]).normalized();
        ASSERT_LT((ray - scene.rays[p]).norm(), 1e-4) << "scene " << i << " solution " << s;
      }
    }
  }
  EXPECT_GE(count, 1000U);
}

TEST(P3p, has_no_solution_for_points_on_a_line_or_in_one_place) {
  const Points rays{Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.1, 0, 1).normalized(),
                    Eigen::Vector3d(0.2, 0, 1).normalized()};
  const Points line{Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(1, 1, 3), Eigen::Vector3d(2, 2, 4)};
  const Points place{Eigen::Vector3d(1, 0, 2), Eigen::Vector3d(1, 0, 2), Eigen::Vector3d(1, 0, 2)};
  EXPECT_EQ(solve_p3p(line, rays).count, 0U);
  EXPECT_EQ(solve_p3p(place, rays).count, 0U);
}

TEST(SolveQuartic, finds_real_roots_only) {
  std::array<double, 4> roots{};
  // (x - 1)(x + 2)(x^2 + 1) = x^4 + x^3 - x^2 + x - 2
  ASSERT_EQ(solve_quartic({-2, 1, -1, 1, 1}, roots), 2U);
  std::sort(roots.begin(), roots.begin() + 2);
  EXPECT_NEAR(roots[0], -2, 1e-9);
  EXPECT_NEAR(roots[1], 1, 1e-9);
  EXPECT_EQ(solve_quartic({1, 0, 0, 0, 1}, roots), 0U);  // x^4 + 1
  EXPECT_EQ(solve_quartic({1, 2, 3, 4, 0}, roots), 0U);  // no quartic
}

}  // namespace
}  // namespace cairn
