// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Holds the lower triangle of a symmetric matrix of 6x6 blocks by columns of blocks; within a column the
/// rows increase from the diagonal on.
struct BlockMatrix {
  std::vector<std::size_t> begin;  ///< begin of each column in `rows` and `blocks`, and their size
  std::vector<std::int32_t> rows;
  std::vector<Matrix6d> blocks;

  [[nodiscard]] std::size_t columns() const { return begin.size() - 1; }
};

/// Solves linear systems whose matrices share one pattern.
class BlockCholesky {
 public:
  virtual ~BlockCholesky() = default;
  /// Factorises the matrix for the calls of `solve` that follow. Returns false if it is not positive
  /// definite.
  [[nodiscard]] virtual bool factorise(const BlockMatrix& matrix) = 0;
  /// Computes the x of matrix * x = right with the matrix last factorised. Returns false if x is not finite.
  [[nodiscard]] virtual bool solve(const Eigen::VectorXd& right, Eigen::VectorXd& x) const = 0;
  /// Computes the x of matrix * x = right. Returns false if the matrix is not positive definite.
  [[nodiscard]] bool solve(const BlockMatrix& matrix, const Eigen::VectorXd& right, Eigen::VectorXd& x) {
    return factorise(matrix) && solve(right, x);
  }
};

/// Names the factorisation.
enum class BlockCholeskyMethod {
  dense,
  sparse,  ///< ordered by approximate minimum degree (Amestoy, Davis, Duff 1996)
};

/// Returns the method that is faster for the matrix's pattern.
[[nodiscard]] BlockCholeskyMethod choose_method(const BlockMatrix& pattern);

/// Makes a solver for matrices of this pattern. It uses one thread and is deterministic.
[[nodiscard]] std::unique_ptr<BlockCholesky> make_block_cholesky(const BlockMatrix& pattern,
                                                                 BlockCholeskyMethod method);

}  // namespace cairn
