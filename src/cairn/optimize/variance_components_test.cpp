// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/variance_components.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// Errors of which the variance is 0.5 + 2 times the second part, and 1 that is known.
VarianceComponents simulated(Eigen::Index rows) {
  Random random(3);
  VarianceComponents components(rows, 2);
  components.known.setOnes();
  components.cut = 1e9;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double part = components.parts(row, 1) = random.uniform(0, 5);
    components.squares[row] = (1.5 + 2 * part) * std::pow(random.normal(), 2);
  }
  return components;
}

TEST(VarianceComponents, iterations_find_them) {
  const VarianceComponents problem = simulated(40'000);
  Eigen::ArrayXd components = Eigen::ArrayXd::Ones(2);
  for (int i = 0; i < 400; ++i) components = problem.improved(components, 1e-9);
  EXPECT_NEAR(components[0], 0.5, 0.15);
  EXPECT_NEAR(components[1], 2, 0.1);
  EXPECT_LT((problem.improved(components, 1e-9) - components).abs().maxCoeff(), 1e-4);
}

TEST(VarianceComponents, weights_count_errors) {
  VarianceComponents twice = simulated(100), weighed = simulated(50);
  twice.parts.bottomRows(50) = twice.parts.topRows(50);
  twice.squares.tail(50) = twice.squares.head(50);
  weighed.weights.setConstant(2);
  const Eigen::ArrayXd start = Eigen::ArrayXd::Ones(2);
  EXPECT_LT((twice.improved(start, 1e-9) - weighed.improved(start, 1e-9)).abs().maxCoeff(), 1e-9);
}

TEST(VarianceComponents, what_no_error_has_is_none) {
  VarianceComponents problem = simulated(50);
  problem.parts.col(1).setZero();
  EXPECT_EQ(problem.improved(Eigen::ArrayXd::Ones(2), 1e-9)[1], 0);
}

TEST(VarianceComponents, a_gross_error_is_cut_off) {
  VarianceComponents problem = simulated(50);
  problem.cut = 4;
  problem.squares[7] = 1e3;
  const Eigen::ArrayXd start = Eigen::ArrayXd::Ones(2), with = problem.improved(start, 1e-9);
  problem.squares[7] = 1e6;
  EXPECT_EQ((problem.improved(start, 1e-9) - with).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace cairn
