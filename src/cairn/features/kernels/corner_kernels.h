// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// FAST-9 of 16 (Rosten and Drummond 2006): a corner is a pixel around which 9 neighbouring pixels of the
/// circle of radius 3 are all brighter, or all darker, by more than a threshold.
struct CornerKernels {
  /// scores[u] for u in [begin, end): the highest threshold with which the pixel is a corner, where that is
  /// at least `threshold` (1 to 254), else 0. Three rows above and below and three columns aside lie in the
  /// image of `width` columns: 3 <= begin, end <= width - 3. Returns whether there is any.
  bool (*score_fast)(const std::uint8_t* row, std::ptrdiff_t stride, int width, int begin, int end,
                     int threshold, std::uint8_t* scores);
  /// Columns in [begin, end) whose score is above 0, above those of the neighbours to the left and in the row
  /// above, and not below the others'. Ascending, into `found`, which has room for all; returns how many. One
  /// row above and below and 64 columns from any column on can be read.
  int (*find_peaks)(const std::uint8_t* scores, std::ptrdiff_t stride, int begin, int end,
                    std::int32_t* found);
  /// Entries of the structure tensor in a window of 7x7, from Sobel's derivatives: sums of dx dx, dx dy, dy
  /// dy. Five pixels around are read.
  void (*structure_tensor)(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t* sums);
};

CAIRN_KERNEL_TABLES(CornerKernels, kCornerKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const CornerKernels& corner_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kCornerKernels);
}

}  // namespace cairn
