// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/error_statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cairn/core/error.h"

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

TEST(ErrorStatistics, PercentilesAreThoseOfNumpy) {
  const std::array errors{4.0, 1.0, 2.0, 5.0};
  EXPECT_EQ(percentile_of(errors, 0), 1.0);
  EXPECT_DOUBLE_EQ(percentile_of(errors, 50), 3.0);
  EXPECT_DOUBLE_EQ(percentile_of(errors, 90), 4.7);
  EXPECT_EQ(percentile_of(errors, 100), 5.0);
  EXPECT_EQ(percentile_of(std::array{7.0}, 99), 7.0);
  EXPECT_THROW((void)percentile_of({}, 50), PreconditionError);
  EXPECT_THROW((void)percentile_of(errors, 101), PreconditionError);
}

TEST(ErrorStatistics, OfNothingAreNothing) {
  EXPECT_FALSE(summarize_errors({}));
}

}  // namespace
}  // namespace cairn
