// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>

#include "cairn/core/random.h"
#include "cairn/simulate/texture.h"

namespace cairn {

/// Describes a rotated rectangle or ellipse of one colour. Lengths in metres on the surface, x right, y down.
struct Shape {
  Eigen::Vector2d center{0, 0};
  Eigen::Vector2d half{0.1, 0.1};  ///< half of its width and height before it is rotated
  double angle = 0;                ///< radians
  bool round = false;              ///< ellipse instead of rectangle
  Color color = Color::Zero();
  float opacity = 1;
};

/// Sets fractal value noise: from octave to octave half the cell and `gain` times the amplitude; cells under
/// two texels are left out.
struct NoiseStyle {
  double cell = 0.6;  ///< metres, of the coarsest octave
  int octaves = 6;
  double gain = 0.75;   ///< amplitude of an octave over that of the coarser one
  float contrast = 18;  ///< standard deviation of all octaves together, grey levels
  float tint = 6;       ///< standard deviation of the shift between warm and cold, grey levels
};

/// Sets shapes at random positions, the larger ones first, sizes spread evenly over the scales between the
/// limits.
struct ScatterStyle {
  double per_square_metre = 30;
  double min_size = 0.01, max_size = 0.15;  ///< metres, half of the long side
  float opacity = 0.8F;
  float saturation = 0.5F;  ///< 0 grey, 1 pure colours
};

/// Holds the picture of a surface while it is painted, in metres, antialiased at its own resolution.
class Canvas {
 public:
  Canvas() = default;
  /// Makes a canvas of this size, metres; `texel` is the side of a pixel in metres. Throws PreconditionError
  /// unless all are above 0.
  Canvas(double width, double height, double texel, const Color& ground);

  [[nodiscard]] double width() const { return width_; }    ///< metres
  [[nodiscard]] double height() const { return height_; }  ///< metres
  [[nodiscard]] const RgbImage& image() const { return image_; }
  [[nodiscard]] RgbImage take() && { return std::move(image_); }

  /// Fills the canvas with one colour.
  void fill(const Color& color);
  /// Adds noise to all pixels.
  void add_noise(const NoiseStyle& style, std::uint64_t seed);
  /// Draws one shape.
  void draw(const Shape& shape);
  /// Draws random shapes whose centres lie within the rectangle from `low` to `high`.
  void scatter(const ScatterStyle& style, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
               Random& random);
  void scatter(const ScatterStyle& style, Random& random) {
    scatter(style, {0, 0}, {width_, height_}, random);
  }
  /// Multiplies all channels by `brightness`.
  void scale(float brightness);
  /// Darkens towards the four borders by up to `share`, over about `reach` metres, as corners get less light.
  void shade_borders(double share, double reach);

 private:
  double width_ = 0, height_ = 0;
  Eigen::Vector2d texel_{0, 0};  // metres; the last column and row end with the surface
  RgbImage image_;
};

/// Returns a random colour, uniform over hues; its brightest channel lies between `min_value` and
/// `max_value`, 0 to 255.
[[nodiscard]] Color random_color(Random& random, float saturation, float min_value, float max_value);

}  // namespace cairn
