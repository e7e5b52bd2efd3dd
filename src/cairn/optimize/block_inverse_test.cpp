// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/block_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

constexpr BlockCholeskyMethod kMethods[] = {BlockCholeskyMethod::dense, BlockCholeskyMethod::sparse};

/// A band of blocks whose ends are joined, as of a drive with a closed loop; positive definite.
BlockMatrix make_loop(std::int32_t columns, std::int32_t width, double diagonal) {
  Random random(5);
  BlockMatrix matrix;
  matrix.begin.push_back(0);
  for (std::int32_t c = 0; c < columns; ++c) {
    for (std::int32_t r = c; r < columns; ++r) {
      if (r - c > width && r - c < columns - 2) continue;
      Matrix6d block;
      for (double& value : block.reshaped()) value = random.uniform(-1, 1);
      matrix.rows.push_back(r);
      matrix.blocks.push_back(r == c ? Matrix6d(block + block.transpose() + diagonal * Matrix6d::Identity())
                                     : block);
    }
    matrix.begin.push_back(matrix.rows.size());
  }
  return matrix;
}

Eigen::MatrixXd to_dense(const BlockMatrix& matrix) {
  const auto size = 6 * static_cast<Eigen::Index>(matrix.columns());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t c = 0; c < matrix.columns(); ++c) {
    for (std::size_t k = matrix.begin[c]; k < matrix.begin[c + 1]; ++k) {
      const auto row = 6 * static_cast<Eigen::Index>(matrix.rows[k]),
                 column = 6 * static_cast<Eigen::Index>(c);
      dense.block<6, 6>(row, column) = matrix.blocks[k];
      dense.block<6, 6>(column, row) = matrix.blocks[k].transpose();
    }
  }
  return dense;
}

TEST(BlockInverse, has_the_blocks_of_the_dense_inverse) {
  const BlockMatrix matrix = make_loop(30, 3, 40);
  const Eigen::MatrixXd expected = to_dense(matrix).inverse();
  for (const auto method : kMethods) {
    const auto inverse = invert_blocks(matrix, method);
    ASSERT_NE(inverse, nullptr);
    for (std::size_t c = 0; c < matrix.columns(); ++c) {
      for (std::size_t k = matrix.begin[c]; k < matrix.begin[c + 1]; ++k) {
        const auto r = static_cast<std::size_t>(matrix.rows[k]);
        const Matrix6d truth = expected.block<6, 6>(6 * matrix.rows[k], 6 * static_cast<Eigen::Index>(c));
        EXPECT_LT((inverse->block(r, c) - truth).norm(), 1e-14) << r << " " << c;
        EXPECT_LT((inverse->block(c, r) - truth.transpose()).norm(), 1e-14) << r << " " << c;
      }
    }
  }
}

TEST(BlockInverse, solves_for_each_column) {
  const BlockMatrix matrix = make_loop(12, 2, 40);
  const Eigen::MatrixXd truth = Eigen::MatrixXd::Random(72, 3);
  for (const auto method : kMethods)
    EXPECT_LT((invert_blocks(matrix, method)->solve(to_dense(matrix) * truth) - truth).norm(), 1e-12);
}

TEST(BlockInverse, refuses_what_is_not_positive_definite) {
  for (const auto method : kMethods) EXPECT_EQ(invert_blocks(make_loop(12, 2, -1), method), nullptr);
}

TEST(BlockInverse, has_no_block_outside_the_pattern) {
  BlockMatrix diagonal;
  diagonal.begin = {0, 1, 2};
  diagonal.rows = {0, 1};
  diagonal.blocks = {Matrix6d::Identity(), Matrix6d::Identity()};
  const auto inverse = invert_blocks(diagonal, BlockCholeskyMethod::sparse);
  EXPECT_THROW((void)inverse->block(1, 0), PreconditionError);
}

}  // namespace
}  // namespace cairn
