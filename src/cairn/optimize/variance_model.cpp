// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/variance_model.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr std::int64_t kMinCount = 100;  // landmarks: fewer say nothing of the distribution
constexpr double kMinFreedom = 2.1;      // with 2 the t distribution has no covariance
constexpr double kMaxFreedom = 1e3;      // more is the same as all landmarks alike
constexpr double kMinFactor = 1e-4;      // s^2 of a fit without residuals, whose logarithm counts for nothing

double shifted_log(double squared_error_sum, double freedom) {
  return std::log(std::max(kMinFactor, squared_error_sum / freedom)) - digamma(freedom / 2) +
         std::log(freedom / 2);
}

}  // namespace

// digamma and trigamma: the recurrence up to x >= 6, then the asymptotic series (Abramowitz and Stegun
// 6.3.18, 6.4.12).
double digamma(double x) {
  double sum = 0;
  for (; x < 6; ++x) sum -= 1 / x;
  const double y = 1 / (x * x);
  return sum + std::log(x) - 0.5 / x - y * (1.0 / 12 - y * (1.0 / 120 - y * (1.0 / 252 - y / 240)));
}

double trigamma(double x) {
  double sum = 0;
  for (; x < 6; ++x) sum += 1 / (x * x);
  const double y = 1 / (x * x);
  return sum + 1 / x + y / 2 + y / x * (1.0 / 6 - y * (1.0 / 30 - y * (1.0 / 42 - y / 30)));
}

// trigamma decreases from infinity to 0, so bisection on a logarithmic scale finds it.
double inverse_trigamma(double value) {
  double low = std::log(1e-8), high = std::log(1e8);
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (trigamma(std::exp(middle)) > value ? low : high) = middle;
  }
  return std::exp((low + high) / 2);
}

void VarianceModel::add(double squared_error_sum, double redundancy) {
  require(redundancy >= 1, "a landmark with redundancy");
  const double e = shifted_log(squared_error_sum, redundancy);
  ++sums_.count;
  sums_.log += e;
  sums_.log_squared += e * e;
  sums_.noise += trigamma(redundancy / 2);
}

VariancePrior VarianceModel::prior() const {
  VariancePrior prior;
  if (sums_.count < kMinCount) return prior;
  const auto n = static_cast<double>(sums_.count);
  const double mean = sums_.log / n, variance = (sums_.log_squared - n * mean * mean) / (n - 1);
  const double own = variance - sums_.noise / n;  // of the landmarks, without that of their few observations
  prior.freedom =
      own > trigamma(kMaxFreedom / 2) ? std::max(kMinFreedom, 2 * inverse_trigamma(own)) : kMaxFreedom;
  prior.scale = std::exp(mean + digamma(prior.freedom / 2) - std::log(prior.freedom / 2));
  return prior;
}

}  // namespace cairn
