// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace cairn {

/// Describes a position in an image, pixels.
struct PixelPosition {
  float u = 0, v = 0;
};

/// Returns the indices, ascending, of `count` of the positions, or of all if there are not more. The
/// positions come strongest first. The strongest are kept, but half of the count is distributed evenly over
/// the cells of a grid on the image.
[[nodiscard]] std::vector<std::size_t> select_uniform(const std::vector<PixelPosition>& places, int width,
                                                      int height, std::size_t count);

}  // namespace cairn
