// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/error_statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace cairn {
namespace {

TEST(ErrorStatistics, AreThoseOfNumpy) {
  const auto even = summarize_errors(std::array{4.0, 1.0, 2.0, 5.0});
  ASSERT_TRUE(even);
  EXPECT_EQ(even->count, 4U);
  EXPECT_DOUBLE_EQ(even->rmse, std::sqrt(46.0 / 4));
  EXPECT_DOUBLE_EQ(even->mean, 3.0);
  EXPECT_DOUBLE_EQ(even->median, 3.0);
  EXPECT_DOUBLE_EQ(even->std, std::sqrt(10.0 / 4));
  EXPECT_EQ(even->min, 1.0);
  EXPECT_EQ(even->max, 5.0);
  EXPECT_EQ(summarize_errors(std::array{3.0, 9.0, 1.0})->median, 3.0);
}

TEST(ErrorStatistics, OfNothingAreNothing) {
  EXPECT_FALSE(summarize_errors({}));
}

}  // namespace
}  // namespace cairn
