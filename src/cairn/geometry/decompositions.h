// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace cairn {

/// Holds the eigenvalues (increasing) and eigenvectors (columns) of a symmetric matrix. Values are NaN if the
/// matrix is not finite.
template <int Size>
struct SymmetricEigen {
  Eigen::Matrix<double, Size, 1> values = Eigen::Matrix<double, Size, 1>::Zero();
  Eigen::Matrix<double, Size, Size> vectors = Eigen::Matrix<double, Size, Size>::Zero();
};

/// Holds the singular values (decreasing) and the orthogonal factors of u * values.asDiagonal() * v^T.
struct Svd3 {
  Eigen::Matrix3d u = Eigen::Matrix3d::Zero();
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  Eigen::Matrix3d v = Eigen::Matrix3d::Zero();
};

// Decompositions that take a compiler seconds each, compiled once for all that use them. Eigen's algorithms;
// an eigenvalue decomposition reads the lower triangle.
/// Decomposes a symmetric 3x3 matrix; reads its lower triangle.
[[nodiscard]] SymmetricEigen<3> eigen_of_symmetric(const Eigen::Matrix3d& matrix);
/// Decomposes a symmetric 6x6 matrix; reads its lower triangle.
[[nodiscard]] SymmetricEigen<6> eigen_of_symmetric(const Eigen::Matrix<double, 6, 6>& matrix);
/// Decomposes a symmetric 9x9 matrix; reads its lower triangle.
[[nodiscard]] SymmetricEigen<9> eigen_of_symmetric(const Eigen::Matrix<double, 9, 9>& matrix);
/// Computes the singular value decomposition of a 3x3 matrix.
[[nodiscard]] Svd3 svd_of(const Eigen::Matrix3d& matrix);

}  // namespace cairn
