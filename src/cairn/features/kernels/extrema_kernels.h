// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Refers to rows v - 1, v and v + 1 of four neighbouring levels of Gaussian images: rows[level][row].
struct GaussianRows {
  const float* rows[4][3];
};

/// Lists the kernels of one instruction set.
struct ExtremaKernels {
  /// Finds extrema: with D the three differences of successive levels, the columns in [begin, end) at which
  /// the middle D has at least the absolute value `threshold` > 0 and, if positive, is not exceeded by any of
  /// its 26 neighbours or, if negative, does not exceed any. Ascending; returns their number. Rows are
  /// readable for 16 floats beyond on either side; `found` has room for end - begin.
  int (*find)(const GaussianRows& gaussians, int begin, int end, float threshold, int* found);
};

CAIRN_KERNEL_TABLES(ExtremaKernels, kExtremaKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const ExtremaKernels& extrema_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kExtremaKernels);
}

}  // namespace cairn
