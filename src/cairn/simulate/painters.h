// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simulate/scene_builder.h"

namespace cairn {

/// Paints surfaces of a furnished room, each full of corners and blobs at many scales, as feature detectors
/// need them. Painters are values: two made with the same arguments paint the same from the same random
/// stream.

/// Paints wallpaper of one colour with `pictures` framed pictures.
[[nodiscard]] Painter wallpaper(const Color& color, int pictures);
/// Paints planks with knots and, if above 0, a patterned rug of `rug` metres (width, height) in the middle.
[[nodiscard]] Painter floor_boards(const Eigen::Vector2d& rug);
[[nodiscard]] Painter ceiling_tiles();
[[nodiscard]] Painter wood(const Color& color);
/// Paints shelves full of books.
[[nodiscard]] Painter book_shelf();
[[nodiscard]] Painter fabric(const Color& color);
/// Paints cardboard with labels and tape.
[[nodiscard]] Painter carton();

}  // namespace cairn
