// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/stage_times.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(StageTimes, are_summed_up_by_nearest_rank) {
  std::vector<double> seconds;
  for (int i = 100; i >= 1; --i) seconds.push_back(i);
  const TimeSummary summary = summarize(seconds);
  EXPECT_DOUBLE_EQ(summary.total, 5050);
  EXPECT_DOUBLE_EQ(summary.median, 50);
  EXPECT_DOUBLE_EQ(summary.percentile_95, 95);
}

TEST(StageTimes, of_one_run_are_that_run) {
  const TimeSummary summary = summarize({0.25});
  EXPECT_DOUBLE_EQ(summary.median, 0.25);
  EXPECT_DOUBLE_EQ(summary.percentile_95, 0.25);
}

TEST(StageTimes, of_none_are_zeros) {
  const TimeSummary summary = summarize({});
  EXPECT_EQ(summary.total, 0);
  EXPECT_EQ(summary.median, 0);
  EXPECT_EQ(summary.percentile_95, 0);
}

}  // namespace
}  // namespace cairn
