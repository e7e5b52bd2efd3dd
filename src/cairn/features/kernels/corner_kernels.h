// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Lists the kernels of one instruction set for FAST-9 of 16 (Rosten and Drummond 2006): a corner is a pixel
/// around which 9 neighbouring pixels of the circle of radius 3 are all brighter, or all darker, by more than
/// a threshold.
struct CornerKernels {
  /// Computes scores[u] for u in [begin, end): the highest threshold at which the pixel is a corner if that
  /// is at least `threshold` (1 to 254), else 0. Three rows above and below and three columns aside lie in
  /// the image of `width` columns: 3 <= begin, end <= width - 3. Returns whether there is a corner.
  bool (*score_fast)(const std::uint8_t* row, std::ptrdiff_t stride, int width, int begin, int end,
                     int threshold, std::uint8_t* scores);
  /// Finds the columns in [begin, end) whose score is above 0, above those of the neighbours to the left and
  /// in the row above, and not below those of the other neighbours. Writes them in ascending order to
  /// `found`, which has room for all; returns their number. One row above and below and 64 columns from any
  /// column on must be readable.
  int (*find_peaks)(const std::uint8_t* scores, std::ptrdiff_t stride, int begin, int end,
                    std::int32_t* found);
  /// Sums the entries of the structure tensor in a window of 7x7, from Sobel's derivatives: dx dx, dx dy, dy
  /// dy. Reads five pixels around.
  void (*structure_tensor)(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* sums);
};

CAIRN_KERNEL_TABLES(CornerKernels, kCornerKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const CornerKernels& corner_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kCornerKernels);
}

}  // namespace cairn
