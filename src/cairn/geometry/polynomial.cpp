// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/polynomial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Coefficients = std::array<double, kMaxDegree + 1>;

struct Polynomial {
  Coefficients c{};
  std::size_t degree = 0;
};

struct Value {
  double at = 0, slope = 0;
};

double value_of(const Polynomial& p, double x) {
  double value = p.c[p.degree];
  for (std::size_t i = p.degree; i-- > 0;) value = value * x + p.c[i];
  return value;
}

Value value_and_slope(const Polynomial& p, double x) {
  Value value{p.c[p.degree], 0};
  for (std::size_t i = p.degree; i-- > 0;) {
    value.slope = value.slope * x + value.at;
    value.at = value.at * x + p.c[i];
  }
  return value;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  result.degree = p.degree - 1;
  for (std::size_t i = 1; i <= p.degree; ++i) result.c[i - 1] = static_cast<double>(i) * p.c[i];
  return result;
}

/// The one root between `low` and `high`, at which p has different signs.
double root_between(const Polynomial& p, double low, double high, bool rises) {
  double x = 0.5 * (low + high);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Value value = value_and_slope(p, x);
    if (value.at == 0) break;
    ((value.at > 0) == rises ? high : low) = x;
    double next = x - value.at / value.slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = next - x;
    x = next;
    if (std::abs(step) <= 1e-15 * std::abs(x)) break;
  }
  return x;
}

/// Roots in [-1, 1], increasing.
std::size_t roots_in_unit_interval(const Polynomial& p, std::span<double> roots) {
  if (p.degree == 0) return 0;
  std::array<double, kMaxDegree + 1> stops{};  // where p's slope may change its sign, and the interval's end
  std::size_t stop_count = roots_in_unit_interval(derivative(p), stops);
  stops[stop_count++] = 1.0;
  std::size_t count = 0;
  double low = -1.0, value_at_low = value_of(p, low);
  for (std::size_t i = 0; i < stop_count; ++i) {
    const double high = stops[i], value_at_high = value_of(p, high);
    if ((value_at_low < 0) != (value_at_high < 0))
      roots[count++] = root_between(p, low, high, value_at_low < 0);
    low = high;
    value_at_low = value_at_high;
  }
  return count;
}

}  // namespace

std::size_t real_roots(std::span<const double> coefficients, std::span<double> roots) {
  require(coefficients.size() >= 2 && coefficients.size() <= kMaxDegree + 1,
          "a polynomial of degree 1 to 10");
  require(roots.size() + 1 >= coefficients.size(), "room for all roots");
  Polynomial p;
  p.degree = coefficients.size() - 1;
  std::copy(coefficients.begin(), coefficients.end(), p.c.begin());
  Polynomial reversed = p;
  std::reverse(reversed.c.begin(), reversed.c.begin() + static_cast<std::ptrdiff_t>(coefficients.size()));
  std::size_t count = roots_in_unit_interval(p, roots);
  std::array<double, kMaxDegree> inverse{};
  const std::size_t inverse_count = roots_in_unit_interval(reversed, inverse);
  for (std::size_t i = 0; i < inverse_count && count < p.degree; ++i)
    if (std::abs(inverse[i]) < 1.0 && inverse[i] != 0) roots[count++] = 1.0 / inverse[i];
  return count;
}

}  // namespace cairn
