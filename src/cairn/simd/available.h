// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cairn/simd/instruction_set.h"

namespace cairn {

[[nodiscard]] std::string_view name_of(InstructionSet set);

/// Those that this build holds and this processor has, ascending; the first is plain.
[[nodiscard]] const std::vector<InstructionSet>& available_instruction_sets();

}  // namespace cairn
