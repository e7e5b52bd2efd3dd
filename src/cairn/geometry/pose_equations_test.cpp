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

TEST(PoseEquations, projection_jacobian_agrees_with_finite_differences) {
  const Eigen::Vector3d point(0.4, -0.7, 2.3);
  const Eigen::Matrix3d jacobian = kRig.projection_jacobian(point);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d numeric = (kRig.project(point + step) - kRig.project(point - step)) / (2 * kStep);
    EXPECT_LT((numeric - jacobian.col(i)).norm(), 1e-5 * (1 + numeric.norm())) << "column " << i;
  }
}

TEST(PoseEquations, tell_which_observations_are_usable) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_usable({320, 240}));
  EXPECT_TRUE(is_usable({320, 240, kNan, 1, 0}));  // no disparity, so its sigma means nothing
  EXPECT_TRUE(is_usable({320, 240, 12, 1, 0.5}));
  EXPECT_FALSE(is_usable({320, kNan}));
  EXPECT_FALSE(is_usable({320, 240, kNan, 0}));
  EXPECT_FALSE(is_usable({320, 240, 12, 1, 0}));
  EXPECT_FALSE(is_usable({320, 240, kInfinite}));
}

TEST(PoseEquations, have_no_solution_where_observations_do_not_determine_the_pose) {
  PoseEquations equations;
  const Eigen::Vector3d points[] = {{0, 0, 2}, {0.5, 0, 2}, {-0.3, 0, 2}};  // free to turn about their line
  for (const auto& point : points) equations.add(whiten(kRig, point, {320, 240}), 1.0);
  EXPECT_FALSE(equations.solve());
  equations.add(whiten(kRig, {0.1, 0.4, 2.5}, {320, 240}), 1.0);
  EXPECT_TRUE(equations.solve());
}

}  // namespace
}  // namespace cairn
