// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/essential.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/decompositions.h"

namespace cairn {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Matrix9x5d = Eigen::Matrix<double, 9, 5>;
using Vector9d = Eigen::Matrix<double, 9, 1>;

/// Two unit vectors across a unit vector.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = direction.unitOrthogonal();
  basis.col(1) = direction.cross(basis.col(0));
  return basis;
}

/// Derivative of E's elements, column by column, by (w, tau): exp(w) R and t + basis tau.
Matrix9x5d essential_jacobian(const Rigid3& b_from_a, const Eigen::Matrix<double, 3, 2>& basis) {
  const Eigen::Matrix3d R = b_from_a.matrix3(), T = skew(b_from_a.translation);
  Matrix9x5d jacobian;
  for (int k = 0; k < 5; ++k) {
    const Eigen::Matrix3d by_parameter = k < 3 ? Eigen::Matrix3d(T * skew(Eigen::Vector3d::Unit(k)) * R)
                                               : Eigen::Matrix3d(skew(basis.col(k - 3)) * R);
    jacobian.col(k) = Eigen::Map<const Vector9d>(by_parameter.data());
  }
  return jacobian;
}

struct SampsonResidual {
  double value = 0;
  Vector9d by_essential = Vector9d::Zero();  ///< column by column
};

/// r = b^T E a / |g| with g the gradient of the product by (a, b); r^2 is sampson_error.
SampsonResidual sampson_residual(const Eigen::Matrix3d& E, const Eigen::Vector3d& a,
                                 const Eigen::Vector3d& b) {
  const Eigen::Vector3d in_b = E * a, in_a = E.transpose() * b;
  const double norm = std::sqrt(in_b.head<2>().squaredNorm() + in_a.head<2>().squaredNorm());
  if (!(norm > 0)) return {};
  SampsonResidual residual;
  residual.value = b.dot(in_b) / norm;
  Eigen::Matrix3d half_gradient = Eigen::Matrix3d::Zero();  // of |g|^2 / 2 by E
  half_gradient.topRows<2>() += in_b.head<2>() * a.transpose();
  half_gradient.leftCols<2>() += b * in_a.head<2>().transpose();
  const Eigen::Matrix3d by_essential = (b * a.transpose() - (residual.value / norm) * half_gradient) / norm;
  residual.by_essential = Eigen::Map<const Vector9d>(by_essential.data());
  return residual;
}

/// False where the pairs do not determine the five parameters.
bool step(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
          std::span<const std::int32_t> used, Rigid3& b_from_a, double& length) {
  const Eigen::Matrix3d E = essential_of(b_from_a);
  const Eigen::Matrix<double, 3, 2> basis = tangent_basis(b_from_a.translation);
  const Matrix9x5d by_parameters = essential_jacobian(b_from_a, basis);
  Matrix5d hessian = Matrix5d::Zero();
  Vector5d gradient = Vector5d::Zero();
  for (const std::int32_t index : used) {
    const auto i = static_cast<std::size_t>(index);
    const SampsonResidual residual = sampson_residual(E, a[i].homogeneous(), b[i].homogeneous());
    const Vector5d jacobian = by_parameters.transpose() * residual.by_essential;
    hessian.noalias() += jacobian * jacobian.transpose();
    gradient.noalias() += residual.value * jacobian;
  }
  const Eigen::LDLT<Matrix5d> factor(hessian);
  constexpr double kSmallestPivot = 1e-12;
  const auto pivots = factor.vectorD();
  if (factor.info() != Eigen::Success || !(pivots.minCoeff() > kSmallestPivot * pivots.maxCoeff()))
    return false;
  const Vector5d change = -factor.solve(gradient);
  if (!change.allFinite()) return false;
  length = change.norm();
  b_from_a.rotation = (rotation_exp(change.head<3>()) * b_from_a.rotation).normalized();
  b_from_a.translation = (b_from_a.translation + basis * change.tail<2>()).normalized();
  return true;
}

}  // namespace

Eigen::Matrix3d essential_of(const Rigid3& b_from_a) {
  return skew(b_from_a.translation) * b_from_a.matrix3();
}

std::array<Rigid3, 4> EssentialDecomposition::candidates() const {
  const Eigen::Quaterniond first(rotations[0]), second(rotations[1]);
  return {Rigid3{first, translation}, Rigid3{first, -translation}, Rigid3{second, translation},
          Rigid3{second, -translation}};
}

EssentialDecomposition decompose_essential(const Eigen::Matrix3d& E) {
  require(E.allFinite(), "the elements of an essential matrix are finite");
  const Svd3 svd = svd_of(E);
  const Eigen::Matrix3d &U = svd.u, &V = svd.v;
  Eigen::Matrix3d W;
  W << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EssentialDecomposition result;
  result.singular_values = (U.transpose() * E * V).diagonal();
  result.factors = {U * W.transpose() * V.transpose(), U * W * V.transpose()};
  const double sign_u = U.determinant() < 0 ? -1 : 1, sign_v = V.determinant() < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 2; ++i) result.rotations[i] = sign_u * sign_v * result.factors[i];
  // U diag(s, s, 0) V^T = sign_u s skew(u_3) U W^T V^T
  result.translation = 0.5 * sign_v * (result.singular_values[0] + result.singular_values[1]) * U.col(2);
  return result;
}

bool refine_essential(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                      std::span<const std::int32_t> used, int iterations, Rigid3& b_from_a) {
  constexpr std::size_t kFewest = 5;
  if (used.size() < kFewest || !(b_from_a.translation.norm() > 0)) return false;
  b_from_a.translation.normalize();
  constexpr double kConverged = 1e-10;  // radians
  double length = 1;
  for (int i = 0; i < iterations && length > kConverged; ++i)
    if (!step(a, b, used, b_from_a, length)) return false;
  return true;
}

}  // namespace cairn
