// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/core/error.h"

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

double percentile_of(std::span<const double> errors, double percent) {
  require(!errors.empty() && percent >= 0 && percent <= 100, "a percentile from 0 to 100 of some errors");
  std::vector<double> sorted(errors.begin(), errors.end());
  std::sort(sorted.begin(), sorted.end());
  const double at = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace cairn
