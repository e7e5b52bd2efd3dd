// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Holds up to four poses camera_from_world that see three points in the directions of three rays.
struct P3pSolutions {
  std::array<Rigid3, 4> camera_from_world;
  std::size_t count = 0;
};

/// Solves the perspective-three-point problem after Grunert 1841, in the form of Haralick et al., IJCV 13(3),
/// 1994: a quartic in the ratio of two distances; the distances are polished on the law of cosines. `rays`
/// are unit vectors in the camera frame. Returns no solution if the points lie on one line or coincide.
[[nodiscard]] P3pSolutions solve_p3p(const std::array<Eigen::Vector3d, 3>& points_in_world,
                                     const std::array<Eigen::Vector3d, 3>& rays);

/// Computes the real roots of c[4] x^4 + ... + c[0] by Durand-Kerner iteration, in no order, and returns
/// their number. Returns 0 if |c[4]| is at most 1e-14.
[[nodiscard]] std::size_t solve_quartic(const std::array<double, 5>& coefficients,
                                        std::array<double, 4>& roots);

}  // namespace cairn
