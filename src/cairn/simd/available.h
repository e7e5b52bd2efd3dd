// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cairn/simd/instruction_set.h"

namespace cairn {

/// Returns the name of a set as CAIRN_SIMD takes it: plain, sse4.2, avx2, avx512.
[[nodiscard]] std::string_view name_of(InstructionSet set);

/// Returns the sets that this build holds and this processor has, ascending; the first is plain.
[[nodiscard]] const std::vector<InstructionSet>& available_instruction_sets();

}  // namespace cairn
