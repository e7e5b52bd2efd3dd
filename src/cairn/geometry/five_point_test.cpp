// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/five_point.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "cairn/geometry/essential.h"
#include "cairn/testing/geometry/two_view_scene.h"

namespace cairn {
namespace {

using testkit::make_two_view_scene;
using testkit::SceneShape;
using testkit::TwoViewScene;

FivePointSolutions solve(const TwoViewScene& scene) {
  std::array<Eigen::Vector2d, 5> a, b;
  std::copy_n(scene.a.begin(), 5, a.begin());
  std::copy_n(scene.b.begin(), 5, b.begin());
  return solve_five_point(a, b);
}

double distance_up_to_sign(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return std::min((a - b).norm(), (a + b).norm());
}

/// Of 2000 problems the truth is among the solutions but for badly conditioned ones: the elimination loses
/// digits, 1e-4 is still a tenth of what a pixel of noise does.
TEST(FivePoint, finds_the_true_essential_matrix) {
  for (const SceneShape shape : {SceneShape::volume, SceneShape::plane}) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      const TwoViewScene scene = make_two_view_scene(seed, 5, 0, 0, 0.5, shape);
      Eigen::Matrix3d truth = essential_of(scene.b_from_a);
      truth *= std::sqrt(2.0) / truth.norm();
      const FivePointSolutions solutions = solve(scene);
      double best = 1;
      for (std::size_t i = 0; i < solutions.count; ++i)
        best = std::min(best, distance_up_to_sign(solutions.essential[i], truth));
      found += best < 1e-4 ? 1 : 0;
    }
    EXPECT_GE(found, 990);
  }
}

TEST(FivePoint, gives_essential_matrices_of_the_five_pairs) {
  int solutions_checked = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const TwoViewScene scene = make_two_view_scene(seed, 5, 5);  // wrong pairs have solutions, too
    const FivePointSolutions solutions = solve(scene);
    for (std::size_t k = 0; k < solutions.count; ++k) {
      const Eigen::Matrix3d& E = solutions.essential[k];
      ++solutions_checked;
      EXPECT_NEAR(E.norm(), std::sqrt(2.0), 1e-12);
      EXPECT_NEAR(E.determinant(), 0, 1e-4);
      for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(scene.b[i].homogeneous().dot(E * scene.a[i].homogeneous()), 0, 1e-10);
    }
  }
  EXPECT_GT(solutions_checked, 400);
}

TEST(FivePoint, of_one_pair_five_times_has_finite_solutions_at_most) {
  TwoViewScene scene = make_two_view_scene(1, 5);
  for (std::size_t i = 1; i < 5; ++i) {
    scene.a[i] = scene.a[0];
    scene.b[i] = scene.b[0];
  }
  const FivePointSolutions solutions = solve(scene);
  EXPECT_LE(solutions.count, 10U);
  for (std::size_t i = 0; i < solutions.count; ++i) EXPECT_TRUE(solutions.essential.at(i).allFinite());
}

}  // namespace
}  // namespace cairn
