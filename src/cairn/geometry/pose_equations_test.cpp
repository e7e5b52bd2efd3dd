// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/pose_equations.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr Rig kRig{525, 525, 319.5, 239.5, 0.075};

TEST(PoseEquations, jacobian_agrees_with_finite_differences) {
  const Eigen::Vector3d point(0.4, -0.7, 2.3);
  const auto jacobian = observation_jacobian(kRig, point);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Vector6d xi = Vector6d::Zero();
    xi[i] = kStep;
    const Eigen::Vector3d numeric =
        (kRig.project(perturb_left(xi, {}) * point) - kRig.project(perturb_left(-xi, {}) * point)) /
        (2 * kStep);
    EXPECT_LT((numeric - jacobian.col(i)).norm(), 1e-5 * (1 + numeric.norm())) << "column " << i;
  }
}

TEST(PoseEquations, have_no_solution_where_observations_do_not_determine_the_pose) {
  PoseEquations equations;
  const Eigen::Vector3d points[] = {{0, 0, 2}, {0.5, 0, 2}, {-0.3, 0, 2}};  // free to turn about their line
  for (const auto& point : points) equations.add(kRig, point, {320, 240}, 1.0);
  EXPECT_FALSE(equations.solve());
  equations.add(kRig, {0.1, 0.4, 2.5}, {320, 240}, 1.0);
  EXPECT_TRUE(equations.solve());
}

}  // namespace
}  // namespace cairn
