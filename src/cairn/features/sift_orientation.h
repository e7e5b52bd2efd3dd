// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/features/sift_extrema.h"

namespace cairn {

/// Finds the dominant directions of the gradients around the point: peaks of their histogram that reach 0.8
/// of the highest (Lowe 2004, section 5), highest first, at least one. Degrees in [0, 360), clockwise from
/// the x axis.
[[nodiscard]] std::vector<float> sift_orientations(const ScaleSpace& space, const ScalePoint& point);

}  // namespace cairn
