// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cairn {

/// Returns the median of `values`, which must not be empty; for an even number the larger of the two in the
/// middle.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The standard deviation of normal errors over the median of their absolute values (Hampel 1974).
inline constexpr double kSigmaPerMedian = 1.4826;

}  // namespace cairn
