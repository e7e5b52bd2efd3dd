// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/features/kernels/dispatch.h"

namespace cairn {

struct HammingKernels {
  /// distances[t] = number of bits in which `query` and train t differ; each has `words` words, trains lie
  /// one after the other.
  void (*distances)(const std::uint64_t* query, const std::uint64_t* trains, std::size_t count,
                    std::size_t words, std::uint32_t* distances);
};

CAIRN_KERNEL_TABLES(HammingKernels, kHammingKernels)

/// The kernels for `set`, which is available.
[[nodiscard]] inline const HammingKernels& hamming_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kHammingKernels);
}

}  // namespace cairn
