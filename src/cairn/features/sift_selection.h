// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/features/sift_extrema.h"

namespace cairn {

/// The strongest `count` of `points` (strongest first, as they come and as they go), spread over the image.
[[nodiscard]] std::vector<ScalePoint> select_spread(const ScaleSpace& space, std::vector<ScalePoint> points,
                                                    int count);

}  // namespace cairn
