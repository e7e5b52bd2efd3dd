// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/stage_times.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn {

TimeSummary summarize(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::sort(seconds.begin(), seconds.end());
  const auto nearest_rank = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(seconds.size()));
    return seconds[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
  };
  return {std::accumulate(seconds.begin(), seconds.end(), 0.0), nearest_rank(0.5), nearest_rank(0.95)};
}

}  // namespace cairn
