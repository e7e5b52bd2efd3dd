// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Rows v - 1, v and v + 1 of four neighbouring levels of Gaussian images: rows[level][row].
struct GaussianRows {
  const float* rows[4][3];
};

struct ExtremaKernels {
  /// With D = the differences of each level and the one before, three in number: columns in [begin, end)
  /// where D in the middle has at least the absolute value `threshold` > 0 and, positive, is not exceeded by
  /// any of its 26 neighbours or, negative, does not exceed any. Ascending; returns how many. Rows are
  /// readable for 16 floats beyond on either side; `found` has room for end - begin.
  int (*find)(const GaussianRows& gaussians, int begin, int end, float threshold, int* found);
};

CAIRN_KERNEL_TABLES(ExtremaKernels, kExtremaKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const ExtremaKernels& extrema_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kExtremaKernels);
}

}  // namespace cairn
