// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cairn/image/image.h"

namespace cairn {

/// Describes where a window of one image lies in another one, in both directions.
struct WindowOffset {
  Eigen::Vector2d offset = {0, 0};  ///< pixel of the other image less that of the first, pixels
  double sigma_px = 0;              ///< standard deviation of its row, from texture and residuals
  double correlation = 0;           ///< share of the window's variance that the other one explains, at most 1
};

/// Measures the offset by least-squares matching (Lucas and Kanade 1981; with the gradients of the first
/// window, as Baker and Matthews 2004, sec. 3.2) of a window of 15x15 pixels around (u, v) of `first`. The
/// unknowns are the offset, the slopes of its column along u and v, a gain and a shift of brightness; the
/// other image is interpolated between 4x4 pixels (Keys 1981). `guess` is the initial offset and `reach_px`
/// how far from it the true one may lie. Returns nullopt where a window leaves its image, has too little
/// texture in either direction, or does not settle within the reach. Slower than measure_disparity, which
/// takes the row as known. Throws PreconditionError if the images' sizes differ.
[[nodiscard]] std::optional<WindowOffset> measure_offset(const GrayImage& first, const GrayImage& other,
                                                         const Eigen::Vector2d& pixel,
                                                         const Eigen::Vector2d& guess, double reach_px);

}  // namespace cairn
