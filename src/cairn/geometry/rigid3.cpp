// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/rigid3.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "cairn/geometry/decompositions.h"

namespace cairn {

Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& rotation_vector) {
  const double angle_squared = rotation_vector.squaredNorm();
  const double angle = std::sqrt(angle_squared);
  // sin(a/2)/a = 1/2 - a^2/48 + ...
  const double scale = angle < 1e-4 ? 0.5 - angle_squared / 48.0 : std::sin(0.5 * angle) / angle;
  const Eigen::Vector3d v = scale * rotation_vector;
  return Eigen::Quaterniond(std::cos(0.5 * angle), v.x(), v.y(), v.z()).normalized();
}

Eigen::Vector3d rotation_log(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * rotation.vec();
  const double sine = v.norm();
  const double cosine = sign * rotation.w();
  // 2 atan(s/c)/s = 2/c - 2 s^2/(3 c^3) + ...
  const double scale = sine < 1e-5 ? 2.0 / cosine - 2.0 * sine * sine / (3.0 * cosine * cosine * cosine)
                                   : 2.0 * std::atan2(sine, cosine) / sine;
  return scale * v;
}

double rotation_angle(const Eigen::Quaterniond& rotation) {
  return 2.0 * std::atan2(rotation.vec().norm(), std::abs(rotation.w()));
}

double deviation_from_rotation(const Eigen::Matrix3d& matrix) {
  if (!(matrix.determinant() > 0)) return std::numeric_limits<double>::infinity();
  return (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

Eigen::Quaterniond nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Svd3 svd = svd_of(matrix);
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.u * svd.v.transpose())).normalized();
}

Rigid3 perturb_left(const Vector6d& xi, const Rigid3& target_from_source) {
  const Eigen::Quaterniond turn = rotation_exp(xi.head<3>());
  return {(turn * target_from_source.rotation).normalized(),
          turn * target_from_source.translation + xi.tail<3>()};
}

Vector6d left_perturbation(const Rigid3& from, const Rigid3& to) {
  const Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
  Vector6d xi;
  xi << rotation_log(turn), to.translation - turn * from.translation;
  return xi;
}

double motion_norm(const Rigid3& motion) {
  return rotation_angle(motion.rotation) + motion.translation.norm();
}

}  // namespace cairn
