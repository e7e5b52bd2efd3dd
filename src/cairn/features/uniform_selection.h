// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace cairn {

/// A place in an image, in pixels.
struct PixelPosition {
  float u = 0, v = 0;
};

/// Indices, ascending, of `count` of the places, or of all where there are not more. They come strongest
/// first, and the strongest are kept, but half of the count is shared out evenly among the cells of a grid
/// over the image.
[[nodiscard]] std::vector<std::size_t> select_uniform(const std::vector<PixelPosition>& places, int width,
                                                      int height, std::size_t count);

}  // namespace cairn
