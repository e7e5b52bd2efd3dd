// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cairn {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Describes a rigid transform target_from_source: point_in_target = rotation * point_in_source +
/// translation.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< Hamilton, unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< metres

  [[nodiscard]] Rigid3 inverse() const {
    const Eigen::Quaterniond inverted = rotation.conjugate();
    return {inverted, -(inverted * translation)};
  }
  /// Returns the rotation as a matrix.
  [[nodiscard]] Eigen::Matrix3d matrix3() const { return rotation.toRotationMatrix(); }
};

/// Maps a point from the source to the target.
[[nodiscard]] inline Eigen::Vector3d operator*(const Rigid3& target_from_source,
                                               const Eigen::Vector3d& point) {
  return target_from_source.rotation * point + target_from_source.translation;
}

/// Composes a_from_c = a_from_b * b_from_c; normalises the rotation, so that long chains stay rotations.
[[nodiscard]] inline Rigid3 operator*(const Rigid3& a_from_b, const Rigid3& b_from_c) {
  return {(a_from_b.rotation * b_from_c.rotation).normalized(),
          a_from_b.rotation * b_from_c.translation + a_from_b.translation};
}

/// Computes the rotation of `rotation_vector` = axis * angle (radians) after Rodrigues, near zero by a
/// series.
[[nodiscard]] Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& rotation_vector);
/// Computes the rotation vector axis * angle of a unit quaternion, angle in [0, pi] radians: the inverse of
/// rotation_exp.
[[nodiscard]] Eigen::Vector3d rotation_log(const Eigen::Quaterniond& rotation);
/// Computes the angle of a rotation, radians in [0, pi].
[[nodiscard]] double rotation_angle(const Eigen::Quaterniond& rotation);

/// Computes the largest entry of |R^T R - 1|, 0 for a rotation. Returns infinity if the matrix mirrors or
/// holds a NaN.
[[nodiscard]] double deviation_from_rotation(const Eigen::Matrix3d& matrix);
/// Computes the rotation nearest to a matrix that is one up to rounding.
[[nodiscard]] Eigen::Quaterniond nearest_rotation(const Eigen::Matrix3d& matrix);

/// Applies the left perturbation xi = (w, v), rotation first, that all solvers use: exp(w) * R and exp(w) * t
/// + v. The translation part is not multiplied by the left Jacobian.
[[nodiscard]] Rigid3 perturb_left(const Vector6d& xi, const Rigid3& target_from_source);
/// Computes the xi with perturb_left(xi, from) = to, angle in [0, pi]: the error of an estimate `from` of a
/// true `to`, in the coordinates in which solvers state covariances.
[[nodiscard]] Vector6d left_perturbation(const Rigid3& from, const Rigid3& to);

/// Returns the matrix with skew(a) * b = a x b.
[[nodiscard]] inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Computes the rotation angle (radians, at most pi) plus the length of the translation (metres): the measure
/// of motion of the keyframe decision.
[[nodiscard]] double motion_norm(const Rigid3& motion);

}  // namespace cairn
