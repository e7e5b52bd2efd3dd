// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/features/kernels/dispatch.h"

namespace cairn {

/// Rows v - 1, v and v + 1 of three neighbouring levels of differences of Gaussians: rows[level][row].
struct DifferenceRows {
  const float* rows[3][3];
};

struct ExtremaKernels {
  /// out[x] = a[x] - b[x]; `count` is a multiple of 16.
  void (*subtract)(const float* a, const float* b, int count, float* out);
  /// Columns in [begin, end) where the middle row of the middle level has at least the absolute value
  /// `threshold` > 0 and is nowhere exceeded among its 26 neighbours, ascending; returns how many. Rows have
  /// room to end + 16. `found` has room for end - begin.
  int (*find)(const DifferenceRows& differences, int begin, int end, float threshold, int* found);
};

CAIRN_KERNEL_TABLES(ExtremaKernels, kExtremaKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const ExtremaKernels& extrema_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kExtremaKernels);
}

}  // namespace cairn
