// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/ransac.h"

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

double log10_binomial(std::size_t n, std::size_t k) {
  const auto log_factorial = [](std::size_t i) { return std::lgamma(static_cast<double>(i) + 1.0); };
  return (log_factorial(n) - log_factorial(k) - log_factorial(n - k)) / std::log(10.0);
}

}  // namespace

void RansacOptions::validate() const {
  require(max_iterations >= 1, "max_iterations is at least 1");
  require(confidence > 0 && confidence < 1, "confidence lies between 0 and 1");
}

std::string_view to_string(RansacStatus status) {
  switch (status) {
    case RansacStatus::too_few_data:
      return "too few data";
    case RansacStatus::degenerate:
      return "the data do not determine it";
    case RansacStatus::by_chance:
      return "no more data agree than would by chance";
    case RansacStatus::ok:
      break;
  }
  return "ok";
}

int samples_needed(std::size_t inliers, std::size_t count, std::size_t sample_size,
                   const RansacOptions& options) {
  const double share = static_cast<double>(inliers) / static_cast<double>(count);
  const double good_sample = std::pow(share, static_cast<double>(sample_size));
  if (good_sample >= options.confidence) return 1;
  const double needed = std::log(1.0 - options.confidence) / std::log1p(-good_sample);
  return needed < options.max_iterations ? static_cast<int>(std::ceil(needed)) : options.max_iterations;
}

double log10_false_alarms(std::size_t inliers, std::size_t count, std::size_t sample_size, std::size_t models,
                          double chance) {
  if (inliers <= sample_size) return std::numeric_limits<double>::infinity();
  return std::log10(static_cast<double>(models)) + log10_binomial(count, inliers) +
         log10_binomial(inliers, sample_size) +
         static_cast<double>(inliers - sample_size) * std::log10(std::clamp(chance, 1e-300, 1.0));
}

}  // namespace cairn
