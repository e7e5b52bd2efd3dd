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

void fill_circle(RgbImage& image, const Eigen::Vector2d& center, double radius, const Rgb8& color);
/// Covers the pixels from `corner` on, `size` (width and height) of them; both are rounded.
void fill_rectangle(RgbImage& image, const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                    const Rgb8& color);

/// Returns a color between two: a for share 0, b for share 1.
[[nodiscard]] Rgb8 mix(const Rgb8& a, const Rgb8& b, double share);

/// The image in grey, from column `left` on, dimmed so that colours stand out. It fits into the picture.
void paste_dimmed(RgbImage& picture, const GrayImage& image, int left);

/// Around the circle of hues at full saturation: 0 red, 1/3 green, 2/3 blue, 1 red again.
[[nodiscard]] Rgb8 color_of_hue(double hue);

}  // namespace cairn
