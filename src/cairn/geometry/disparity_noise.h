// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "cairn/geometry/rig.h"

namespace cairn {

/// Describes how sure the disparities of a depth camera are. Structured light and stereo measure disparity,
/// so the first part is the same at any depth z; errors of time-of-flight cameras, rounding to millimetres
/// and depth that is misaligned with colour show in the second one. Together a depth has the standard
/// deviation hypot(sigma_px z^2 / (fx b), sigma_m).
struct DisparityNoise {
  double sigma_px = 0;  ///< part in disparity, pixels
  double sigma_m = 0;   ///< part in depth, metres

  /// Computes the standard deviation of the disparity `d`, pixels.
  [[nodiscard]] double at(const Rig& rig, double d) const {
    return std::hypot(sigma_px, sigma_m * rig.disparity_per_metre(d));
  }
  /// Computes the standard deviation of a depth, metres.
  [[nodiscard]] double of_depth(const Rig& rig, double depth) const {
    return std::hypot(sigma_px * depth * depth / (rig.fx * rig.baseline), sigma_m);
  }
};

/// The noise of a Kinect v1 at features: 2.3 mm at 1 m and 21 mm at 3 m, twice what Khoshelham and Elberink
/// 2012 measured, because features lie where depth is worst.
inline constexpr DisparityNoise kKinectNoise{0.09, 0};

}  // namespace cairn
