// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/matching/kernels/distance_kernels.h"
#include "cairn/simd/dispatch.h"

namespace cairn {

CAIRN_KERNEL_TABLES(DistanceKernels, kL2Kernels)

/// Returns the kernels for the squared Euclidean distance of bytes, exact for descriptors of at most 32768
/// bytes, for `set`, which must be available.
[[nodiscard]] inline const DistanceKernels& l2_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kL2Kernels);
}

}  // namespace cairn
