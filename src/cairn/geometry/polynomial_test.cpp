// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

/// Coefficients of the product of (x - root) and, for each pair, x^2 + b x + c.
std::vector<double> polynomial_with(const std::vector<double>& roots, int complex_pairs, Random& random) {
  std::vector<double> c{1.0};
  const auto multiply = [&](const std::vector<double>& factor) {
    std::vector<double> product(c.size() + factor.size() - 1);
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < factor.size(); ++j) product[i + j] += c[i] * factor[j];
    c = product;
  };
  for (const double root : roots) multiply({-root, 1.0});
  for (int i = 0; i < complex_pairs; ++i) {
    const double real = random.uniform(-2, 2), imaginary = random.uniform(0.3, 2);
    multiply({real * real + imaginary * imaginary, -2 * real, 1.0});
  }
  return c;
}

std::vector<double> sorted_roots(const std::vector<double>& coefficients) {
  std::vector<double> roots(kMaxDegree);
  roots.resize(real_roots(coefficients, roots));
  std::sort(roots.begin(), roots.end());
  return roots;
}

TEST(Polynomial, finds_all_real_roots_and_no_others) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const int pairs = trial % 4, reals = trial % 5;
    if (pairs + reals == 0) continue;
    std::vector<double> roots;
    for (int i = 0; i < std::min(reals, 10 - 2 * pairs); ++i)
      roots.push_back(-3.0 + 1.5 * i + random.uniform(0, 1));
    const std::vector<double> c = polynomial_with(roots, pairs, random);
    const std::vector<double> found = sorted_roots(c);
    ASSERT_EQ(found.size(), roots.size()) << "trial " << trial;
    for (std::size_t i = 0; i < roots.size(); ++i) EXPECT_NEAR(found[i], roots[i], 1e-8) << "trial " << trial;
  }
}

TEST(Polynomial, finds_huge_and_tiny_roots) {
  const std::vector<double> roots{-1e6, 1e-6, 3.0};
  Random random(2);
  const std::vector<double> found = sorted_roots(polynomial_with(roots, 0, random));
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / roots[i], 1.0, 1e-9);
}

TEST(Polynomial, takes_vanishing_leading_coefficients) {
  std::array<double, 3> found{};
  ASSERT_EQ(real_roots(std::array{-0.5, 1.0, 0.0, 0.0}, found), 1U);
  EXPECT_DOUBLE_EQ(found[0], 0.5);
  EXPECT_EQ(real_roots(std::array{1.0, 0.0, 0.0, 0.0}, found), 0U);
  EXPECT_THROW((void)real_roots(std::array{1.0}, found), PreconditionError);
}

}  // namespace
}  // namespace cairn
