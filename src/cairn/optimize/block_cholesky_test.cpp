// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/block_cholesky.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr BlockCholeskyMethod kMethods[] = {BlockCholeskyMethod::dense, BlockCholeskyMethod::sparse};

Matrix6d random_block(Random& random) {
  Matrix6d block;
  for (double& value : block.reshaped()) value = random.uniform(-1, 1);
  return block;
}

/// Positive definite, with blocks up to `width` below the diagonal.
BlockMatrix make_band(std::size_t columns, std::size_t width, std::uint64_t seed) {
  Random random(seed);
  BlockMatrix band;
  band.begin.push_back(0);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = c; r < std::min(columns, c + width + 1); ++r) {
      band.rows.push_back(static_cast<std::int32_t>(r));
      const Matrix6d block = random_block(random);
      const double size = 12.0 * static_cast<double>(width + 1);
      band.blocks.push_back(r == c ? Matrix6d(block * block.transpose() + size * Matrix6d::Identity())
                                   : block);
    }
    band.begin.push_back(band.rows.size());
  }
  return band;
}

Eigen::VectorXd multiply(const BlockMatrix& lower, const Eigen::VectorXd& x) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  for (std::size_t c = 0; c < lower.columns(); ++c) {
    const auto column = 6 * static_cast<Eigen::Index>(c);
    for (std::size_t k = lower.begin[c]; k < lower.begin[c + 1]; ++k) {
      const Eigen::Index row = 6 * lower.rows[k];
      product.segment<6>(row) += lower.blocks[k] * x.segment<6>(column);
      if (row != column) product.segment<6>(column) += lower.blocks[k].transpose() * x.segment<6>(row);
    }
  }
  return product;
}

TEST(BlockCholesky, solves) {
  for (const auto method : kMethods) {
    const BlockMatrix matrix = make_band(30, 4, 1);
    const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(180, -1, 1);
    const auto cholesky = make_block_cholesky(matrix, method);
    Eigen::VectorXd x;
    for (int repeat = 0; repeat < 2; ++repeat) {
      ASSERT_TRUE(cholesky->solve(matrix, multiply(matrix, truth), x));
      EXPECT_LT((x - truth).norm(), 1e-12);
    }
  }
}

TEST(BlockCholesky, solves_for_several_right_sides_with_one_factorisation) {
  for (const auto method : kMethods) {
    const BlockMatrix matrix = make_band(30, 4, 5);
    const auto cholesky = make_block_cholesky(matrix, method);
    ASSERT_TRUE(cholesky->factorise(matrix));
    for (const double size : {1.0, 3.0}) {
      const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(180, -size, size);
      Eigen::VectorXd x, at_once;
      ASSERT_TRUE(cholesky->solve(multiply(matrix, truth), x));
      EXPECT_LT((x - truth).norm(), 1e-12 * size);
      ASSERT_TRUE(make_block_cholesky(matrix, method)->solve(matrix, multiply(matrix, truth), at_once));
      EXPECT_EQ(x, at_once);
    }
  }
}

TEST(BlockCholesky, reads_the_lower_triangle_alone) {
  for (const auto method : kMethods) {
    BlockMatrix matrix = make_band(3, 2, 2);
    const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(18, -1, 1), right = multiply(matrix, truth);
    for (const std::size_t diagonal : {0U, 3U, 5U})
      matrix.blocks[diagonal].triangularView<Eigen::StrictlyUpper>().setConstant(1e9);
    Eigen::VectorXd x;
    ASSERT_TRUE(make_block_cholesky(matrix, method)->solve(matrix, right, x));
    EXPECT_LT((x - truth).norm(), 1e-12);
  }
}

TEST(BlockCholesky, says_when_the_matrix_is_not_positive_definite) {
  for (const auto method : kMethods) {
    BlockMatrix matrix = make_band(5, 1, 3);
    matrix.blocks[4](2, 2) = -1;
    Eigen::VectorXd x;
    EXPECT_FALSE(make_block_cholesky(matrix, method)->solve(matrix, Eigen::VectorXd::Ones(30), x));
  }
}

TEST(BlockCholesky, is_dense_where_cameras_are_few_or_all_linked) {
  EXPECT_EQ(choose_method(make_band(10, 2, 4)), BlockCholeskyMethod::dense);
  EXPECT_EQ(choose_method(make_band(100, 99, 4)), BlockCholeskyMethod::dense);
  EXPECT_EQ(choose_method(make_band(300, 5, 4)), BlockCholeskyMethod::sparse);
}

}  // namespace
}  // namespace cairn
