// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <limits>

namespace cairn {
namespace {

template <int Size>
SymmetricEigen<Size> decompose(const Eigen::Matrix<double, Size, Size>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Size, Size>> solver(matrix);
  if (solver.info() == Eigen::Success) return {solver.eigenvalues(), solver.eigenvectors()};
  SymmetricEigen<Size> none;
  none.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  return none;
}

}  // namespace

SymmetricEigen<3> eigen_of_symmetric(const Eigen::Matrix3d& matrix) {
  return decompose<3>(matrix);
}
SymmetricEigen<6> eigen_of_symmetric(const Eigen::Matrix<double, 6, 6>& matrix) {
  return decompose<6>(matrix);
}
SymmetricEigen<9> eigen_of_symmetric(const Eigen::Matrix<double, 9, 9>& matrix) {
  return decompose<9>(matrix);
}

Svd3 svd_of(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace cairn
