// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/decompositions.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

template <int Size>
Eigen::Matrix<double, Size, Size> random_matrix(std::uint64_t seed) {
  Random random(seed);
  return Eigen::Matrix<double, Size, Size>::NullaryExpr([&] { return random.normal(); });
}

template <int Size>
void expect_decomposed() {
  const auto any = random_matrix<Size>(Size);
  const Eigen::Matrix<double, Size, Size> symmetric = any + any.transpose();
  const SymmetricEigen<Size> eigen = eigen_of_symmetric(symmetric);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - symmetric).norm(),
            1e-12);
  for (int i = 1; i < Size; ++i) EXPECT_LE(eigen.values[i - 1], eigen.values[i]);
}

TEST(Decompositions, eigenvalues_and_vectors_give_the_matrix_back) {
  expect_decomposed<3>();
  expect_decomposed<6>();
  expect_decomposed<9>();
}

TEST(Decompositions, singular_values_and_factors_give_the_matrix_back) {
  const Eigen::Matrix3d matrix = random_matrix<3>(4);
  const Svd3 svd = svd_of(matrix);
  EXPECT_LT((svd.u * svd.values.asDiagonal() * svd.v.transpose() - matrix).norm(), 1e-12);
  EXPECT_NEAR(std::abs(svd.u.determinant()), 1, 1e-12);
  EXPECT_GE(svd.values[0], svd.values[1]);
  EXPECT_GE(svd.values[1], svd.values[2]);
}

TEST(Decompositions, what_is_not_finite_has_no_eigenvalues) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(eigen_of_symmetric(matrix).values.hasNaN());
}

}  // namespace
}  // namespace cairn
