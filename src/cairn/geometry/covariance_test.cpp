// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

Eigen::Matrix3d random_matrix(Random& random) {
  Eigen::Matrix3d matrix;
  for (double& entry : matrix.reshaped()) entry = random.uniform(-1, 1);
  return matrix;
}

TEST(Covariance, propagated_ones_are_symmetric_to_the_last_bit) {
  Random random(3);
  int plain_ones_that_are_not = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d half = random_matrix(random), jacobian = random_matrix(random);
    const Eigen::Matrix3d covariance = as_covariance(half * half.transpose());
    const Eigen::Matrix3d plain = jacobian * covariance * jacobian.transpose();
    const Eigen::Matrix3d propagated = propagate_covariance(jacobian, covariance);
    EXPECT_EQ(propagated, Eigen::Matrix3d(propagated.transpose()));
    EXPECT_LT((propagated - plain).norm(), 1e-14);
    plain_ones_that_are_not += plain == plain.transpose() ? 0 : 1;
  }
  EXPECT_GT(plain_ones_that_are_not, 50);  // what the helper is for
}

TEST(Covariance, of_another_size) {
  const Eigen::Matrix<double, 2, 3> jacobian{{1, 2, 0}, {0, 1, -1}};
  const Eigen::Matrix2d propagated =
      propagate_covariance(jacobian, Eigen::Matrix3d(Eigen::Vector3d(1, 4, 9).asDiagonal()));
  EXPECT_EQ(propagated, (Eigen::Matrix2d() << 17, 8, 8, 13).finished());
}

TEST(Covariance, has_no_variance_below_zero) {
  Eigen::Matrix3d rounded = Eigen::Matrix3d::Identity();
  rounded(1, 1) = -1e-20;
  EXPECT_EQ(as_covariance(rounded)(1, 1), 0);
  EXPECT_EQ(as_covariance(rounded)(0, 0), 1);
}

TEST(Covariance, what_is_no_number_stays) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 0) = std::numeric_limits<double>::quiet_NaN();
  matrix(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(as_covariance(matrix)(0, 0)));
  EXPECT_TRUE(std::isinf(as_covariance(matrix)(1, 1)));
}

}  // namespace
}  // namespace cairn
