// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "cairn/image/image.h"

namespace cairn {

enum class LetteringAnchor { start, middle, end };

struct Lettering {
  double height_px = 13;  ///< of a digit
  Rgb8 color{30, 41, 59};
  LetteringAnchor anchor = LetteringAnchor::start;
  bool bold = false;
};

/// Writes a line of text into an image in strokes, as on a technical drawing. `place` is the left end, the
/// middle or the right end of its baseline, pixels. Knows digits, the lower-case letters of English, E, N,
/// blanks and `. , : - < >`; PreconditionError for others.
void draw_text(RgbImage& image, const Eigen::Vector2d& place, std::string_view text,
               const Lettering& lettering = {});

/// Returns how wide a text is that is `height_px` pixels high, pixels. PreconditionError as draw_text.
[[nodiscard]] double text_width(std::string_view text, double height_px);

}  // namespace cairn
