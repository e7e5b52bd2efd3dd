// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/geometry/rig.h"

namespace cairn {

/// Holds the coefficients c0, c1, c2 (pixels) of what a stereo pair adds to each true disparity: c0 + c1 x +
/// c2 x^2, with x = (u - cx) / fx of the measured column u.
using DisparityField = Eigen::Vector3d;

/// Computes (1, x, x^2), the derivative of a disparity by the coefficients of its field; `u` is the measured
/// column, pixels.
[[nodiscard]] inline Eigen::Vector3d disparity_field_basis(const Rig& rig, double u) {
  const double x = (u - rig.cx) / rig.fx;
  return {1.0, x, x * x};
}

}  // namespace cairn
