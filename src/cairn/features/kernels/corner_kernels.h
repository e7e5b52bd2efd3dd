// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/features/kernels/dispatch.h"

namespace cairn {

struct CornerKernels {
  /// FAST-9 of 16 (Rosten and Drummond 2006): columns in [begin, end) of `row` around which 9 neighbouring
  /// pixels of the circle of radius 3 are all brighter or all darker by more than `threshold` (1 to 254).
  /// Ascending, into `found`, which has room for end - begin; returns how many. Three rows above and below
  /// and three columns aside are read.
  int (*find_fast)(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
                   std::int32_t* found);
  /// The highest threshold with which the pixel would still be found, 0 where there is none.
  int (*fast_score)(const std::uint8_t* pixel, std::ptrdiff_t stride);
  /// Entries of the structure tensor in a window of 7x7, from Sobel's derivatives: sums of dx dx, dx dy, dy
  /// dy. Four pixels around are read.
  void (*structure_tensor)(const std::uint8_t* pixel, std::ptrdiff_t stride, std::int32_t sums[3]);
};

CAIRN_KERNEL_TABLES(CornerKernels, kCornerKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const CornerKernels& corner_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kCornerKernels);
}

}  // namespace cairn
