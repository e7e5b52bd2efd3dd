// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/chi_square.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void check(double degrees_of_freedom) {
  constexpr double kMost = 1e9;
  require(degrees_of_freedom >= 1 && degrees_of_freedom <= kMost, "degrees of freedom are 1 to 1e9");
}

/// x^a e^-x / gamma(a + 1). For large a the powers are taken relative to a (Loader 2000, "Fast and accurate
/// computation of binomial probabilities"), with Stirling's series for gamma (Abramowitz and Stegun 6.1.41):
/// the plain form would lose as many digits as a log a has.
double leading_factor(double a, double x) {
  constexpr double kLarge = 30;  // the first term left out of the series is 1 / (1680 a^7) = 3e-14
  if (a < kLarge) {
    int sign = 0;
    // std::lgamma writes a global, which threads would share
    return std::exp(a * std::log(x) - x - ::lgamma_r(a + 1, &sign));
  }
  const double excess = (x - a) / a;
  const double stirling = (1.0 / 12 - (1.0 / 360 - 1.0 / (1260 * a * a)) / (a * a)) / a;
  return std::exp(a * (std::log1p(excess) - excess) - stirling) / std::sqrt(2 * std::numbers::pi * a);
}

/// P(a, x) by its series, Abramowitz and Stegun 6.5.29; for x below a + 1, where it converges fast.
double lower_by_series(double a, double x) {
  double term = 1, sum = 1;
  for (double n = 1; term > kEpsilon * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return leading_factor(a, x) * sum;
}

/// 1 - P(a, x) by its continued fraction, Abramowitz and Stegun 6.5.31, evaluated from the front by Lentz's
/// method (Thompson and Barnett 1986, "Coulomb and Bessel functions of complex arguments and order"); for x
/// from a + 1 on.
double upper_by_fraction(double a, double x) {
  double b = x + 1 - a, c = 1 / std::numeric_limits<double>::min(), d = 1 / b, fraction = d;
  for (double n = 1;; ++n) {
    const double numerator = -n * (n - a);
    b += 2;
    d = 1 / (numerator * d + b);
    c = b + numerator / c;
    fraction *= d * c;
    if (std::abs(d * c - 1) <= 4 * kEpsilon) return leading_factor(a, x) * a * fraction;
  }
}

/// Density of a chi-square variable times its value: the derivative of the probability by the logarithm of
/// the value.
double slope(double value, double degrees_of_freedom) {
  const double a = 0.5 * degrees_of_freedom;
  return a * leading_factor(a, 0.5 * value);
}

}  // namespace

double chi_square_probability(double value, double degrees_of_freedom) {
  check(degrees_of_freedom);
  require(!std::isnan(value), "a chi-square value is a number");
  if (value <= 0) return 0;
  if (std::isinf(value)) return 1;
  const double a = 0.5 * degrees_of_freedom, x = 0.5 * value;
  return x < a + 1 ? lower_by_series(a, x) : 1 - upper_by_fraction(a, x);
}

/// Newton's method in log(value), which makes small values harmless, kept inside a bracket by bisection.
double chi_square_quantile(double probability, double degrees_of_freedom) {
  check(degrees_of_freedom);
  require(probability > 0 && probability < 1, "a probability lies between 0 and 1");
  double low = -1400, high = std::log(degrees_of_freedom) + 10;  // e^-1400 would be 0
  double position = std::log(degrees_of_freedom);
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = std::exp(position);
    const double excess = chi_square_probability(value, degrees_of_freedom) - probability;
    (excess > 0 ? high : low) = position;
    double next = position - excess / slope(value, degrees_of_freedom);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - position) <= 2 * kEpsilon * std::max(1.0, std::abs(position))) return std::exp(next);
    position = next;
  }
  return std::exp(position);
}

}  // namespace cairn
