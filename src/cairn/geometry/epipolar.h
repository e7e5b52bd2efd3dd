// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/geometry/rig.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Computes the distance in pixels of `pixel_b` from the epipolar line of `pixel_a`, the line l = K^-T [t]x R
/// K^-1 p_a of b_from_a = (R, t) (Hartley and Zisserman 2004, sec. 9.2). Returns NaN if there is no line:
/// without translation, or if `pixel_a` is the epipole.
[[nodiscard]] double epipolar_distance(const Rig& rig, const Rigid3& b_from_a, const Eigen::Vector2d& pixel_a,
                                       const Eigen::Vector2d& pixel_b);

}  // namespace cairn
