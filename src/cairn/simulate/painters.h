// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simulate/scene_builder.h"

namespace cairn {

/// Surfaces of a furnished room, each full of corners and blobs at many scales, as feature detectors like
/// them. Painters are values: two made with the same arguments paint the same from the same random stream.

/// Wallpaper of one colour with `pictures` framed pictures.
[[nodiscard]] Painter wallpaper(const Color& color, int pictures);
/// Planks with knots, and a patterned rug of `rug` metres (width, height) in the middle where above 0.
[[nodiscard]] Painter floor_boards(const Eigen::Vector2d& rug);
[[nodiscard]] Painter ceiling_tiles();
[[nodiscard]] Painter wood(const Color& color);
/// Shelves full of books.
[[nodiscard]] Painter book_shelf();
[[nodiscard]] Painter fabric(const Color& color);
/// Cardboard with labels and tape.
[[nodiscard]] Painter carton();

}  // namespace cairn
