// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/matching/kernels/distance_kernels.h"
#include "cairn/simd/dispatch.h"

namespace cairn {

CAIRN_KERNEL_TABLES(DistanceKernels, kHammingKernels)

/// Returns the kernels for the number of bits that differ, for `set`, which must be available.
[[nodiscard]] inline const DistanceKernels& hamming_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kHammingKernels);
}

}  // namespace cairn
