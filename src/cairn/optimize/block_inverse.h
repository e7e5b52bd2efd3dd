// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cairn/optimize/block_cholesky.h"

namespace cairn {

/// Computes blocks of the inverse of a symmetric positive definite matrix without the whole inverse: those of
/// the pattern of its Cholesky factor, which holds the matrix's own (Takahashi, Fagan, Chin 1973, "Formation
/// of a sparse bus impedance matrix and its application to short circuit study").
class BlockInverse {
 public:
  virtual ~BlockInverse() = default;
  /// Returns the block at (row, column), either triangle. Throws PreconditionError if the matrix has neither
  /// this block nor the transposed one.
  [[nodiscard]] virtual Matrix6d block(std::size_t row, std::size_t column) const = 0;
  /// Computes the x of matrix * x = right, for each column.
  [[nodiscard]] virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const = 0;
};

/// Inverts a matrix that has at least one column. Returns nullptr if it is not positive definite. Uses one
/// thread and is deterministic.
[[nodiscard]] std::unique_ptr<BlockInverse> invert_blocks(const BlockMatrix& matrix,
                                                          BlockCholeskyMethod method);

}  // namespace cairn
