// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// The lower triangle of a symmetric matrix of 6x6 blocks, by columns of blocks. Within a column the rows
/// increase from the diagonal on.
struct BlockMatrix {
  std::vector<std::size_t> begin;  ///< of each column in the two below, and one more
  std::vector<std::int32_t> rows;
  std::vector<Matrix6d> blocks;

  [[nodiscard]] std::size_t columns() const { return begin.size() - 1; }
};

/// Solves with matrices of one pattern, again and again.
class BlockCholesky {
 public:
  virtual ~BlockCholesky() = default;
  /// The x of matrix * x = right; false where the matrix is not positive definite.
  [[nodiscard]] virtual bool solve(const BlockMatrix& matrix, const Eigen::VectorXd& right,
                                   Eigen::VectorXd& x) = 0;
};

enum class BlockCholeskyMethod {
  dense,
  sparse,  ///< ordered by approximate minimum degree (Amestoy, Davis, Duff 1996)
};

/// The faster one for the matrix's pattern.
[[nodiscard]] BlockCholeskyMethod choose_method(const BlockMatrix& pattern);

/// One thread, deterministic.
[[nodiscard]] std::unique_ptr<BlockCholesky> make_block_cholesky(const BlockMatrix& pattern,
                                                                 BlockCholeskyMethod method);

}  // namespace cairn
