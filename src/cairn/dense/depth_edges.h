// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/image/image.h"

namespace cairn {

/// Returns the depth image without the pixels near its edges, where an RGB-D camera measures a mixture of
/// foreground and background ("flying pixels") and the colour belongs to the other side. At an edge, depths
/// two pixels apart, in a row or a column, differ by more than `max_step` of the smaller one; both are
/// removed. Pixels without depth make no edge. Takes about 0.5 ms for 640x480.
[[nodiscard]] DepthImage without_depth_edges(const DepthImage& depth, double max_step);

}  // namespace cairn
