// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/association.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// |x - y|, which an int64 does not always hold.
std::uint64_t distance(std::int64_t x, std::int64_t y) {
  const auto low = static_cast<std::uint64_t>(std::min(x, y)),
             high = static_cast<std::uint64_t>(std::max(x, y));
  return high - low;
}

bool increases_strictly(std::span<const std::int64_t> stamps) {
  return std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) == stamps.end();
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> associate_stamps(std::span<const std::int64_t> a,
                                                                  std::span<const std::int64_t> b,
                                                                  std::int64_t max_gap_ns) {
  require(increases_strictly(a) && increases_strictly(b), "stamps to associate increase strictly");
  if (max_gap_ns < 0) return {};
  const auto max_gap = static_cast<std::uint64_t>(max_gap_ns);
  std::vector<std::tuple<std::uint64_t, std::size_t, std::size_t>> candidates;
  std::size_t first = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (first < b.size() && b[first] < a[i] && distance(a[i], b[first]) > max_gap) ++first;
    for (std::size_t j = first; j < b.size() && distance(a[i], b[j]) <= max_gap; ++j)
      candidates.emplace_back(distance(a[i], b[j]), i, j);
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
