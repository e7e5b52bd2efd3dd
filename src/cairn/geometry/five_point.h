// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace cairn {

/// Holds up to ten essential matrices E with b_i^T E a_i = 0, Frobenius norm sqrt(2).
struct FivePointSolutions {
  std::array<Eigen::Matrix3d, 10> essential;
  std::size_t count = 0;
};

/// Solves the five-point problem after Nister, PAMI 26(6), 2004, sec. 3: E = x X + y Y + z Z + W over the
/// null space of the five epipolar constraints; det E = 0 and 2 E E^T E = tr(E E^T) E are ten cubics, which
/// Gauss-Jordan elimination reduces to one polynomial of degree 10 in z. `a` and `b` are (x/z, y/z) in the
/// first and the second camera. Returns no solution if the elimination meets a vanishing pivot.
[[nodiscard]] FivePointSolutions solve_five_point(const std::array<Eigen::Vector2d, 5>& a,
                                                  const std::array<Eigen::Vector2d, 5>& b);

}  // namespace cairn
