// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {

std::optional<ErrorStatistics> summarize_errors(std::span<const double> errors) {
  if (errors.empty()) return std::nullopt;
  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  ErrorStatistics result;
  result.count = errors.size();
  result.min = sorted.front();
  result.max = sorted.back();
  const std::size_t middle = sorted.size() / 2;
  result.median = sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
  const auto count = static_cast<double>(errors.size());
  double sum = 0, squares = 0, deviations = 0;
  for (const double error : errors) sum += error;
  for (const double error : errors) squares += error * error;
  result.mean = sum / count;
  for (const double error : errors) deviations += (error - result.mean) * (error - result.mean);
  result.rmse = std::sqrt(squares / count);
  result.std = std::sqrt(deviations / count);
  return result;
}

}  // namespace cairn
