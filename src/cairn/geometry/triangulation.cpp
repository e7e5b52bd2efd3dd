// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/triangulation.h"

#include <Eigen/LU>
#include <cmath>

namespace cairn {
namespace {

/// Normal equations of three unknowns.
struct Equations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();

  template <int Rows>
  void add(const Eigen::Matrix<double, Rows, 3>& jacobian, const Eigen::Matrix<double, Rows, 1>& error) {
    hessian.noalias() += jacobian.transpose() * jacobian;
    gradient.noalias() += jacobian.transpose() * error;
  }
  [[nodiscard]] std::optional<Eigen::Vector3d> solve() const {
    bool invertible = false;
    Eigen::Matrix3d inverse;
    hessian.computeInverseWithCheck(inverse, invertible, 0.0);
    if (!invertible) return std::nullopt;
    return -inverse * gradient;
  }
};

std::optional<Eigen::Vector3d> solve_linear(const Rigid3& b_from_a, const Eigen::Vector2d& a,
                                            const Eigen::Vector2d& b) {
  const Eigen::Matrix3d cross_a = skew(a.homogeneous()), cross_b = skew(b.homogeneous());
  Equations equations;
  equations.add<3>(cross_a, Eigen::Vector3d::Zero());
  equations.add<3>(cross_b * b_from_a.matrix3(), cross_b * b_from_a.translation);
  return equations.solve();
}

/// Derivative of (x/z, y/z) by the point.
Eigen::Matrix<double, 2, 3> projection_jacobian(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> jacobian;
  jacobian << 1, 0, -p.x() / p.z(), 0, 1, -p.y() / p.z();
  return jacobian / p.z();
}

}  // namespace

std::optional<TriangulatedPoint> triangulate(const Rigid3& b_from_a, const Eigen::Vector2d& a,
                                             const Eigen::Vector2d& b, double min_angle) {
  const Eigen::Matrix3d R = b_from_a.matrix3();
  const Eigen::Vector3d ray_a = a.homogeneous(), ray_b = R.transpose() * b.homogeneous();
  const double angle = std::atan2(ray_a.cross(ray_b).norm(), ray_a.dot(ray_b));
  if (!(angle >= min_angle)) return std::nullopt;
  auto point = solve_linear(b_from_a, a, b);
  if (!point) return std::nullopt;
  constexpr int kIterations = 3;
  for (int i = 0;; ++i) {
    const Eigen::Vector3d in_b = R * *point + b_from_a.translation;
    if (!(point->z() > 0) || !(in_b.z() > 0)) return std::nullopt;
    const Eigen::Vector2d error_a = point->hnormalized() - a, error_b = in_b.hnormalized() - b;
    if (i == kIterations)
      return TriangulatedPoint{*point, angle, error_a.squaredNorm() + error_b.squaredNorm()};
    Equations equations;
    equations.add<2>(projection_jacobian(*point), error_a);
    equations.add<2>(projection_jacobian(in_b) * R, error_b);
    const auto step = equations.solve();
    if (!step) return std::nullopt;
    *point += *step;
  }
}

}  // namespace cairn
