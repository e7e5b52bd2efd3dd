// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace cairn {

/// Returns the covariance that `matrix` is up to rounding: symmetric to the last bit, and no variance below
/// zero. NaN and infinity stay. Every product and inverse that states a covariance goes through here, as the
/// files take none that is not symmetric.
template <class Derived>
[[nodiscard]] typename Derived::PlainObject as_covariance(const Eigen::MatrixBase<Derived>& matrix) {
  const typename Derived::PlainObject given = matrix;
  typename Derived::PlainObject covariance = 0.5 * (given + given.transpose());
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    if (covariance(i, i) < 0) covariance(i, i) = 0;
  return covariance;
}

/// Computes the covariance J C J^T of y = J x, where C is that of x.
template <class Jacobian, class Covariance>
[[nodiscard]] auto propagate_covariance(const Eigen::MatrixBase<Jacobian>& jacobian,
                                        const Eigen::MatrixBase<Covariance>& covariance) {
  using Result = Eigen::Matrix<double, Jacobian::RowsAtCompileTime, Jacobian::RowsAtCompileTime>;
  return as_covariance(Result(jacobian * covariance * jacobian.transpose()));
}

}  // namespace cairn
