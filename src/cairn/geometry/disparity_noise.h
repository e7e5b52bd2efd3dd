// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "cairn/geometry/rig.h"

namespace cairn {

/// Describes how sure the disparities of a depth camera are. Structured light and stereo measure disparity,
/// so the first part is the same at any depth z; a time of flight, whole millimetres, or depth that lies
/// beside its colour, show in the second one. Together a depth has the standard deviation
/// hypot(sigma_px z^2 / (fx b), sigma_m).
struct DisparityNoise {
  double sigma_px = 0;  ///< part in disparity, pixels
  double sigma_m = 0;   ///< part in depth, metres

  /// Computes the standard deviation of the disparity `d`, pixels: the derivative of d by the depth is
  /// d^2 / (fx b).
  [[nodiscard]] double at(const Rig& rig, double d) const {
    return std::hypot(sigma_px, sigma_m * d * d / (rig.fx * rig.baseline));
  }
  /// Computes the standard deviation of a depth, metres.
  [[nodiscard]] double of_depth(const Rig& rig, double depth) const {
    return std::hypot(sigma_px * depth * depth / (rig.fx * rig.baseline), sigma_m);
  }
};

}  // namespace cairn
