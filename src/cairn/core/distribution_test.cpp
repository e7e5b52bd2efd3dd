// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

TEST(Distribution, quantiles_are_good_to_a_thousandth) {
  Random random(42);
  std::vector<double> values;
  for (int i = 0; i < 20001; ++i) values.push_back(std::exp(6 * random.normal()) * (i % 5 == 0 ? -1 : 1));
  Distribution distribution;
  for (const double value : values) distribution.add(value);
  std::sort(values.begin(), values.end());
  for (const double share : {0.0, 0.01, 0.05, 0.2, 0.5, 0.777, 0.95, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * 20001)));
    const double exact = values[rank - 1];
    EXPECT_NEAR(distribution.quantile(share), exact, 1e-3 * std::abs(exact)) << share;
  }
  EXPECT_EQ(distribution.min(), values.front());
  EXPECT_EQ(distribution.max(), values.back());
  EXPECT_EQ(distribution.count(), 20001U);
}

TEST(Distribution, of_whole_numbers_is_exact) {
  Distribution distribution;
  for (int i = 1; i <= 1000; ++i) distribution.add(i);
  EXPECT_EQ(distribution.quantile(0.05), 50);
  EXPECT_EQ(distribution.quantile(0.5), 500);
  EXPECT_EQ(distribution.quantile(0.95), 950);
  EXPECT_EQ(distribution.quantile(1), 1000);
  EXPECT_DOUBLE_EQ(distribution.mean(), 500.5);
}

TEST(Distribution, knows_infinite_values_and_zeros) {
  const double infinite = std::numeric_limits<double>::infinity();
  Distribution distribution;
  for (const double value : {0.0, 0.0, 3.0, infinite}) distribution.add(value);
  EXPECT_EQ(distribution.quantile(0.5), 0);
  EXPECT_EQ(distribution.quantile(0.75), 3);
  EXPECT_EQ(distribution.quantile(1), infinite);
  EXPECT_EQ(distribution.max(), infinite);
}

TEST(Distribution, of_nothing_has_no_figures) {
  EXPECT_THROW((void)Distribution().mean(), PreconditionError);
  EXPECT_THROW((void)Distribution().quantile(0.5), PreconditionError);
  EXPECT_THROW(Distribution().add(std::nan("")), PreconditionError);
}

}  // namespace
}  // namespace cairn
