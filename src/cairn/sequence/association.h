// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cairn {

/// Pairs positions (i in a, j in b) whose stamps differ by at most `max_gap_ns`, closest pairs first, each
/// stamp used once (Sturm et al. 2012, the TUM benchmark's associate.py); ties go to the earlier stamps. Both
/// inputs increase strictly; so do both sides of the result. O(n log n) for gaps shorter than the spacing of
/// the stamps.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> associate_stamps(
    std::span<const std::int64_t> a, std::span<const std::int64_t> b, std::int64_t max_gap_ns);

}  // namespace cairn
