// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/image/image.h"

namespace cairn {

// Antialiased strokes on an image; (0, 0) is the centre of the first pixel. What lies outside is left out.

void draw_line(RgbImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Rgb8& color,
               double width = 1);
void draw_circle(RgbImage& image, const Eigen::Vector2d& center, double radius, const Rgb8& color,
                 double width = 1);

/// The image in grey, from column `left` on, dimmed so that colours stand out. It fits into the picture.
void paste_dimmed(RgbImage& picture, const GrayImage& image, int left);

/// Around the circle of hues at full saturation: 0 red, 1/3 green, 2/3 blue, 1 red again.
[[nodiscard]] Rgb8 color_of_hue(double hue);

}  // namespace cairn
