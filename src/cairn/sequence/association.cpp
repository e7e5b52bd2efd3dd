// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/association.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace cairn {

std::vector<std::pair<std::size_t, std::size_t>> associate_stamps(std::span<const std::int64_t> a,
                                                                  std::span<const std::int64_t> b,
                                                                  std::int64_t max_gap_ns) {
  std::vector<std::tuple<std::int64_t, std::size_t, std::size_t>> candidates;
  std::size_t first = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (first < b.size() && b[first] < a[i] - max_gap_ns) ++first;
    for (std::size_t j = first; j < b.size() && b[j] <= a[i] + max_gap_ns; ++j)
      candidates.emplace_back(std::abs(a[i] - b[j]), i, j);
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> a_used(a.size()), b_used(b.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [gap, i, j] : candidates) {
    if (a_used[i] || b_used[j]) continue;
    a_used[i] = b_used[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace cairn
