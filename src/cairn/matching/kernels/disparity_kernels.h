// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// A window of the left image, 16 pixels wide and 13 high around its centre pixel: columns -8 to 7, rows -6
/// to 6. One row fills one register of AVX-512.
struct DisparityWindow {
  static constexpr int kWidth = 16, kLeft = 8, kHalfHeight = 6, kHeight = 13;
  static constexpr int kGradientReach = 2;       ///< pixels left and right of it that `prepare` reads
  static constexpr int kInterpolationReach = 3;  ///< that `compare` reads left and right of the moved window

  alignas(64) float pixels[kHeight * kWidth];     ///< grey levels less 128
  alignas(64) float gradients[kHeight * kWidth];  ///< grey levels a pixel, along the row
};

/// With weights w, gradients g and pixels l of the left window, (x, y) from its centre, and r of the right
/// one moved by the disparity: sums over the window, added in one order on every instruction set.
struct DisparityNormal {
  static constexpr int kUnknowns = 5;
  /// Upper triangle, row by row, of the sum of w j j' with j = (g, g x, g y, l, 1).
  double matrix[kUnknowns * (kUnknowns + 1) / 2];
};
struct DisparityDifference {
  double sum;      ///< of w (l - r)
  double squares;  ///< of w (l - r)^2
};
struct DisparityResiduals {
  double projected[DisparityNormal::kUnknowns];  ///< sum of w j (l - r)
  double squares;                                ///< sum of w (l - r)^2
};

struct DisparityKernels {
  /// `centre` is the window's centre pixel in an image whose rows are `stride` bytes apart.
  void (*prepare)(const std::uint8_t* centre, std::ptrdiff_t stride, DisparityWindow& window,
                  DisparityNormal& normal);
  /// `centre` is the pixel of the right image at the left window's centre; the window is moved by whole
  /// pixels.
  void (*difference)(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
                     int disparity, DisparityDifference& result);
  /// The same with row y taken at x - (disparity + row_slope * y), interpolated between six pixels of its row
  /// (Lagrange).
  void (*compare)(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
                  float disparity, float row_slope, DisparityResiduals& residuals);
};

CAIRN_KERNEL_TABLES(DisparityKernels, kDisparityKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const DisparityKernels& disparity_kernels(
    InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kDisparityKernels);
}

}  // namespace cairn
