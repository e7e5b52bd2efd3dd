// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Holds a window of the left image, 16 pixels wide and 13 high around its centre pixel: columns -8 to 7,
/// rows -6 to 6. One row fills one register of AVX-512.
struct DisparityWindow {
  static constexpr int kWidth = 16, kLeft = 8, kHalfHeight = 6, kHeight = 13;
  static constexpr int kGradientReach = 2;  ///< pixels left and right of the window that `prepare` reads
  /// Pixels left and right of the moved window that `compare` reads.
  static constexpr int kInterpolationReach = 3;

  alignas(64) float pixels[kHeight * kWidth];     ///< grey levels less 128
  alignas(64) float gradients[kHeight * kWidth];  ///< grey levels per pixel, along the row
};

/// Holds the normal matrix of a window. With weights w, gradients g and pixels l of the left window, (x, y)
/// from its centre, and r of the right one moved by the disparity; sums over the window are added in one
/// order on every instruction set.
struct DisparityNormal {
  static constexpr int kUnknowns = 5;
  /// Upper triangle, row by row, of the sum of w j j' with j = (g, g x, g y, l, 1).
  double matrix[kUnknowns * (kUnknowns + 1) / 2];
};
/// Holds weighted sums of the differences of the left and the right window.
struct DisparityDifference {
  double sum;      ///< of w (l - r)
  double squares;  ///< of w (l - r)^2
};
/// Holds the right side of the normal equations and the weighted squares of the differences.
struct DisparityResiduals {
  double projected[DisparityNormal::kUnknowns];  ///< sum of w j (l - r)
  double squares;                                ///< sum of w (l - r)^2
};

/// Lists the kernels of one instruction set.
struct DisparityKernels {
  /// Fills `window` and its normal matrix; `centre` is the window's centre pixel in an image whose rows are
  /// `stride` bytes apart.
  void (*prepare)(const std::uint8_t* centre, std::ptrdiff_t stride, DisparityWindow& window,
                  DisparityNormal& normal);
  /// Compares with the right window moved by whole pixels; `centre` is the pixel of the right image at the
  /// left window's centre.
  void (*difference)(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
                     int disparity, DisparityDifference& result);
  /// Compares with the right window whose row y is taken at x - (disparity + row_slope * y), interpolated
  /// between six pixels of the row (Lagrange). `centre` is the pixel of the right image at the left window's
  /// centre.
  void (*compare)(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
                  float disparity, float row_slope, DisparityResiduals& residuals);
};

CAIRN_KERNEL_TABLES(DisparityKernels, kDisparityKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const DisparityKernels& disparity_kernels(
    InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kDisparityKernels);
}

}  // namespace cairn
