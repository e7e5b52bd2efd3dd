// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Describes which pixels of the source row eight neighbouring pixels of a resized row are interpolated from.
struct ResizeBlock {
  std::int32_t first = 0;     ///< column of the first of 16 source pixels, all inside the row
  std::uint8_t source[16]{};  ///< left and right source of each output pixel, relative to `first`
  std::int8_t weight[16]{};   ///< weights of the sources in 1/64; each pair adds up to 64
};

/// Lists the kernels of one instruction set.
struct ImageKernels {
  /// Resizes along the row: 8 * blocks outputs, each 64 times the grey level.
  void (*resize_row)(const std::uint8_t* row, const ResizeBlock* blocks, int count, std::int16_t* out);
  /// Interpolates between rows: out[i] = round((upper[i] + (lower[i] - upper[i]) * weight / 32768) / 64),
  /// weight in [0, 32768).
  void (*blend_rows)(const std::int16_t* upper, const std::int16_t* lower, int weight, int width,
                     std::uint8_t* out);
  /// Smooths once by a Gaussian of 7 pixels with a standard deviation of 2, in 1/256: out[i] from rows[k][i],
  /// k = 0..6. With rows[k] = row + k it smooths along a row.
  void (*blur_seven)(const std::uint8_t* const* rows, int width, std::uint8_t* out);
};

CAIRN_KERNEL_TABLES(ImageKernels, kImageKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const ImageKernels& image_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kImageKernels);
}

}  // namespace cairn
