// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Eight neighbouring pixels of a resized row: what they take from the row that it is made of.
struct ResizeBlock {
  std::int32_t first = 0;     ///< column of the first of 16 source pixels, all inside the row
  std::uint8_t source[16]{};  ///< for each output pixel its left and right source, relative to `first`
  std::int8_t weight[16]{};   ///< of these, in 1/64; each pair adds up to 64
};

struct ImageKernels {
  /// Resizes along the row: 8 * blocks outputs, each 64 times the grey level.
  void (*resize_row)(const std::uint8_t* row, const ResizeBlock* blocks, int count, std::int16_t* out);
  /// out[i] = round((upper[i] + (lower[i] - upper[i]) * weight / 32768) / 64), weight in [0, 32768).
  void (*blend_rows)(const std::int16_t* upper, const std::int16_t* lower, int weight, int width,
                     std::uint8_t* out);
  /// One Gaussian pass over 7 pixels with a standard deviation of 2, in 1/256: out[i] from rows[k][i], k =
  /// 0..6. With rows[k] = row + k it runs along a row.
  void (*blur_seven)(const std::uint8_t* const* rows, int width, std::uint8_t* out);
};

CAIRN_KERNEL_TABLES(ImageKernels, kImageKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const ImageKernels& image_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kImageKernels);
}

}  // namespace cairn
