// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace cairn {

/// Returns `matrix`, a covariance up to rounding, made symmetric to the last bit and without variances below
/// zero. NaN and infinity stay. Every product and inverse that states a covariance goes through here, because
/// the files accept only symmetric ones.
template <class Derived>
[[nodiscard]] typename Derived::PlainObject as_covariance(const Eigen::MatrixBase<Derived>& matrix) {
  const typename Derived::PlainObject given = matrix;
  typename Derived::PlainObject covariance = 0.5 * (given + given.transpose());
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    if (covariance(i, i) < 0) covariance(i, i) = 0;
  return covariance;
}

/// Computes the covariance J C J^T of y = J x, with C the covariance of x.
template <class Jacobian, class Covariance>
[[nodiscard]] auto propagate_covariance(const Eigen::MatrixBase<Jacobian>& jacobian,
                                        const Eigen::MatrixBase<Covariance>& covariance) {
  using Result = Eigen::Matrix<double, Jacobian::RowsAtCompileTime, Jacobian::RowsAtCompileTime>;
  return as_covariance(Result(jacobian * covariance * jacobian.transpose()));
}

}  // namespace cairn
