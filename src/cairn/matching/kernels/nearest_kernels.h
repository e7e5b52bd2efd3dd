// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "cairn/simd/dispatch.h"

namespace cairn {

/// Value that is larger than any distance.
inline constexpr std::int32_t kNoDistance = std::numeric_limits<std::int32_t>::max();

/// Holds the two smallest of some distances and their positions, or kNoDistance and -1 if there is none.
struct TwoSmallest {
  std::int32_t first = kNoDistance, first_at = -1;
  std::int32_t second = kNoDistance, second_at = -1;
};

/// Refers to the smallest distances so far of some columns, each with the row that it is in.
struct ColumnMinima {
  std::int32_t* distances = nullptr;
  std::int32_t* rows = nullptr;
};

/// Lists the kernels of one instruction set. Of equal distances, the one at the lower position or row counts
/// as smaller. Distances are in [0, kNoDistance]; kNoDistance is never found.
struct NearestKernels {
  /// Finds the smallest distance; the second stays unset. `count` is a multiple of 16.
  TwoSmallest (*smallest)(const std::int32_t* distances, std::size_t count);
  /// Finds the two smallest distances. `count` is a multiple of 16.
  TwoSmallest (*two_smallest)(const std::int32_t* distances, std::size_t count);
  /// Updates the minima with `rows` rows: row r begins at distances + r * count and has the number first_row
  /// + r. Rows come in ascending order, also over several calls.
  void (*update_columns)(const std::int32_t* distances, std::size_t rows, std::size_t count,
                         std::int32_t first_row, const ColumnMinima& minima);
};

CAIRN_KERNEL_TABLES(NearestKernels, kNearestKernels)

/// Returns the kernels for `set`, which must be available.
[[nodiscard]] inline const NearestKernels& nearest_kernels(InstructionSet set = default_instruction_set()) {
  return CAIRN_CHOOSE_KERNELS(set, kNearestKernels);
}

}  // namespace cairn
