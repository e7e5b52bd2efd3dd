// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/shared_error.h"

#include <algorithm>
#include <cmath>

#include "cairn/survey/variance_model.h"

namespace cairn {

void SharedErrorModel::add(double difference, int observations) {
  if (!(difference > 0) || !std::isfinite(difference)) return;
  ++sums_.count;
  sums_.log += std::log(difference);
  sums_.observations += observations;
}

double SharedErrorModel::share() const {
  constexpr std::int64_t kMinCount = 100;  // landmarks: as in VarianceModel
  if (sums_.count < kMinCount) return 0;
  const auto count = static_cast<double>(sums_.count);
  const double expected = digamma(1.5) + std::log(2.0 / 3);  // of chi-square with 3 degrees of freedom, / 3
  const double excess = std::exp(sums_.log / count - expected) - 1;
  return std::max(0.0, 2 * excess * count / sums_.observations);
}

}  // namespace cairn
