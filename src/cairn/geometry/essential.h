// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "cairn/geometry/rigid3.h"

namespace cairn {

// Two views a and b of one scene. A point seen at (x/z, y/z) = a and b satisfies (b, 1)^T E (a, 1) = 0 with
// E = skew(t) R for b_from_a = (R, t); the scale of t and the sign of E are free (Longuet-Higgins 1981).

/// Computes the essential matrix skew(t) R of b_from_a = (R, t).
[[nodiscard]] Eigen::Matrix3d essential_of(const Rigid3& b_from_a);

/// Computes the squared distance of (a, b) in R^4 from the pairs that satisfy E exactly, to first order
/// (Sampson 1982; Hartley and Zisserman 2004, eq. 11.9), in squared units of x/z.
[[nodiscard]] inline double sampson_error(const Eigen::Matrix3d& E, const Eigen::Vector2d& a,
                                          const Eigen::Vector2d& b) {
  const Eigen::Vector3d line_in_b = E.leftCols<2>() * a + E.col(2);
  const double ax = E(0, 0) * b.x() + E(1, 0) * b.y() + E(2, 0);
  const double ay = E(0, 1) * b.x() + E(1, 1) * b.y() + E(2, 1);
  const double product = b.x() * line_in_b.x() + b.y() * line_in_b.y() + line_in_b.z();
  const double gradient = line_in_b.x() * line_in_b.x() + line_in_b.y() * line_in_b.y() + ax * ax + ay * ay;
  return product * product / gradient;
}

/// Holds the factors of E = U diag(s) V^T.
struct EssentialDecomposition {
  Eigen::Vector3d singular_values;           ///< decreasing; s, s, 0 for an essential matrix
  std::array<Eigen::Matrix3d, 2> factors;    ///< U W^T V^T and U W V^T; both with determinant 1, or -1
  std::array<Eigen::Matrix3d, 2> rotations;  ///< the factors times their determinant
  Eigen::Vector3d translation;               ///< length (s_1 + s_2) / 2, along the left null vector of E

  /// Returns (R1, t), (R1, -t), (R2, t), (R2, -t): the possible b_from_a, up to scale. A point lies in front
  /// of both cameras in at most one of them.
  [[nodiscard]] std::array<Rigid3, 4> candidates() const;
};

/// Computes the rotations +-U W^T V^T and +-U W V^T, W a quarter turn about z, and the translation +-u_3
/// (Hartley and Zisserman 2004, result 9.19), with signs such that both are rotations and
///
///     skew(translation) rotations[0] = skew(-translation) rotations[1] = E
///
/// if E is an essential matrix; otherwise the products are the essential matrix nearest to E. Throws
/// PreconditionError if an element is not finite.
[[nodiscard]] EssentialDecomposition decompose_essential(const Eigen::Matrix3d& E);

/// Minimises the sum of sampson_error over the pairs at the positions `used` by Gauss-Newton steps on the
/// left perturbation of the rotation and the direction of the translation (5 parameters). Changes `b_from_a`;
/// its translation becomes a unit vector. Returns false if the pairs do not determine the motion: fewer than
/// five, or no translation.
[[nodiscard]] bool refine_essential(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                                    std::span<const std::int32_t> used, int iterations, Rigid3& b_from_a);

}  // namespace cairn
