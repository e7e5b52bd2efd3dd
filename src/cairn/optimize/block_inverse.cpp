// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/block_inverse.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <utility>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr Eigen::Index kBlock = 6;

class DenseInverse : public BlockInverse {
 public:
  /// Returns whether the matrix is positive definite.
  [[nodiscard]] bool invert(const BlockMatrix& matrix) {
    const auto size = kBlock * static_cast<Eigen::Index>(matrix.columns());
    Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t c = 0; c < matrix.columns(); ++c) {
      for (std::size_t k = matrix.begin[c]; k < matrix.begin[c + 1]; ++k)
        lower.block<kBlock, kBlock>(kBlock * matrix.rows[k], kBlock * static_cast<Eigen::Index>(c)) =
            matrix.blocks[k];
    }
    factor_.compute(lower);
    if (factor_.info() != Eigen::Success) return false;
    inverse_ = factor_.solve(Eigen::MatrixXd::Identity(size, size));
    return inverse_.allFinite();
  }

  [[nodiscard]] Matrix6d block(std::size_t row, std::size_t column) const override {
    return inverse_.block<kBlock, kBlock>(kBlock * static_cast<Eigen::Index>(row),
                                          kBlock * static_cast<Eigen::Index>(column));
  }

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const override {
    return factor_.solve(right);
  }

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd inverse_;
};

class SparseInverse : public BlockInverse {
 public:
  /// Returns whether the matrix is positive definite.
  [[nodiscard]] bool invert(const BlockMatrix& matrix) {
    const Matrix lower = to_sparse(matrix);
    factor_.compute(lower);
    if (factor_.info() != Eigen::Success) return false;
    inverse_ = factor_.matrixL().nestedExpression();
    select(factor_.matrixL().nestedExpression());
    return inverse_.coeffs().allFinite();
  }

  [[nodiscard]] Matrix6d block(std::size_t row, std::size_t column) const override {
    Matrix6d block;
    for (Eigen::Index c = 0; c < kBlock; ++c) {
      for (Eigen::Index r = 0; r < kBlock; ++r) block(r, c) = at(place_of(row, r), place_of(column, c));
    }
    return block;
  }

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const override {
    return factor_.solve(right);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  static Matrix to_sparse(const BlockMatrix& matrix) {
    const auto size = kBlock * static_cast<Eigen::Index>(matrix.columns());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(matrix.blocks.size() * kBlock * kBlock);
    for (std::size_t c = 0; c < matrix.columns(); ++c) {
      for (std::size_t k = matrix.begin[c]; k < matrix.begin[c + 1]; ++k) {
        for (Eigen::Index j = 0; j < kBlock; ++j) {
          for (Eigen::Index i = 0; i < kBlock; ++i)
            entries.emplace_back(static_cast<int>(kBlock * matrix.rows[k] + i),
                                 static_cast<int>(kBlock * static_cast<Eigen::Index>(c) + j),
                                 matrix.blocks[k](i, j));
        }
      }
    }
    Matrix lower(size, size);
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
  }

  /// Computes the inverse Z on the pattern of the factor L, from the last column to the first: with l the
  /// column below the diagonal d, z = -Z l / d and z_dd = (1 / d - l^T z) / d. All of Z that a column needs
  /// is in the pattern, because the rows of a column of L are joined with each other.
  void select(const Matrix& factor) {
    std::vector<Eigen::Index> place(static_cast<std::size_t>(factor.rows()), -1);
    for (Eigen::Index column = factor.cols() - 1; column >= 0; --column) select_column(factor, column, place);
  }

  /// `place` has -1 for each row, before and after.
  void select_column(const Matrix& factor, Eigen::Index column, std::vector<Eigen::Index>& place) {
    const Eigen::Index begin = factor.outerIndexPtr()[column];
    const Eigen::Index count = factor.outerIndexPtr()[column + 1] - begin - 1;  // below the diagonal
    const int* rows = factor.innerIndexPtr() + begin + 1;
    const Eigen::Map<const Eigen::VectorXd> below(factor.valuePtr() + begin + 1, count);
    for (Eigen::Index i = 0; i < count; ++i) place[static_cast<std::size_t>(rows[i])] = i;
    Eigen::VectorXd product = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Matrix::InnerIterator entry(inverse_, rows[i]); entry; ++entry) {
        const Eigen::Index k = place[static_cast<std::size_t>(entry.row())];
        if (k < 0) continue;
        product[k] += entry.value() * below[i];
        if (k != i) product[i] += entry.value() * below[k];
      }
    }
    const double diagonal = factor.valuePtr()[begin];
    Eigen::Map<Eigen::VectorXd> selected(inverse_.valuePtr() + begin + 1, count);
    selected = -product / diagonal;
    inverse_.valuePtr()[begin] = (1.0 / diagonal - below.dot(selected)) / diagonal;
    for (Eigen::Index i = 0; i < count; ++i) place[static_cast<std::size_t>(rows[i])] = -1;
  }

  [[nodiscard]] Eigen::Index place_of(std::size_t block, Eigen::Index i) const {
    return factor_.permutationP().indices()[kBlock * static_cast<Eigen::Index>(block) + i];
  }

  [[nodiscard]] double at(Eigen::Index row, Eigen::Index column) const {
    if (row < column) std::swap(row, column);
    const int* begin = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[column];
    const int* end = inverse_.innerIndexPtr() + inverse_.outerIndexPtr()[column + 1];
    const int* found = std::lower_bound(begin, end, static_cast<int>(row));
    require(found != end && *found == row, "the block is in the pattern");
    return inverse_.valuePtr()[found - inverse_.innerIndexPtr()];
  }

  Eigen::SimplicialLLT<Matrix> factor_;
  Matrix inverse_;  // lower triangle, in the order of the factor
};

template <class Inverse>
std::unique_ptr<BlockInverse> invert_by(const BlockMatrix& matrix) {
  auto inverse = std::make_unique<Inverse>();
  if (!inverse->invert(matrix)) return nullptr;
  return inverse;
}

}  // namespace

std::unique_ptr<BlockInverse> invert_blocks(const BlockMatrix& matrix, BlockCholeskyMethod method) {
  return method == BlockCholeskyMethod::dense ? invert_by<DenseInverse>(matrix)
                                              : invert_by<SparseInverse>(matrix);
}

}  // namespace cairn
