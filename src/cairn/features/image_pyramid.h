// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/image/image.h"

namespace cairn {

/// Holds one image at ever coarser scales. Level 0 is the image itself.
struct ImagePyramid {
  /// Holds one level and its scale.
  struct Level {
    GrayImage image;
    double scale_u = 1, scale_v = 1;  ///< pixels of level 0 per pixel of this level

    /// Converts a column (row) of this level to one of level 0; pixel centres are whole numbers in both.
    [[nodiscard]] double u_in_image(double u) const { return (u + 0.5) * scale_u - 0.5; }
    [[nodiscard]] double v_in_image(double v) const { return (v + 0.5) * scale_v - 0.5; }
  };
  std::vector<Level> levels;
};

/// Sets the levels of a pyramid.
struct PyramidOptions {
  int levels = 8;
  double scale = 1.2;  ///< factor between levels, in (1, 1.8]
  /// Pixels: levels with a shorter side are left out, and those after a level with a side below 16.
  int smallest_side = 1;
};

/// Builds a pyramid; each level is resized bilinearly from the one before it. Returns an empty one if a side
/// of the image is below smallest_side. Throws PreconditionError if an option is out of range.
[[nodiscard]] ImagePyramid build_pyramid(const GrayImage& image, const PyramidOptions& options,
                                         const Executor& executor = Executor());

/// Resizes an image bilinearly with pixel areas kept aligned. Both sides of the image are at least 16 pixels
/// and 1 to 1.8 times those of the result; throws PreconditionError otherwise.
[[nodiscard]] GrayImage resize_bilinear(const GrayImage& image, int width, int height,
                                        const Executor& executor = Executor());

/// Smooths by a Gaussian of 7x7 pixels with a standard deviation of 2; the border mirrors the image. Returns
/// images with a side below 4 pixels unchanged.
[[nodiscard]] GrayImage smooth_for_brief(const GrayImage& image, const Executor& executor = Executor());

}  // namespace cairn
