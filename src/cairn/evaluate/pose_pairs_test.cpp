// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_pairs.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// Poses at these milliseconds; x is the stamp in seconds, so that a pair shows where it came from.
Trajectory at_ms(std::initializer_list<int> stamps_ms) {
  Trajectory trajectory;
  for (const int stamp : stamps_ms)
    trajectory.push_back({stamp * 1'000'000LL, {Eigen::Quaterniond::Identity(), {0.001 * stamp, 0, 0}}});
  return trajectory;
}

std::vector<std::pair<int, int>> pairs_ms(const Trajectory& estimate, const Trajectory& reference,
                                          double max_gap_s) {
  std::vector<std::pair<int, int>> result;
  for (const auto& pair : pair_poses(estimate, reference, max_gap_s)) {
    EXPECT_EQ(pair.stamp_ns, std::llround(1e9 * pair.estimate.translation.x()));
    result.emplace_back(std::lround(1e3 * pair.estimate.translation.x()),
                        std::lround(1e3 * pair.reference.translation.x()));
  }
  return result;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(PosePairs, TakeTheNearestFirstAndEachOnce) {
  // 104 is nearer to 105 than 100 is; 100 is left with 90, which is within the limit
  EXPECT_EQ(pairs_ms(at_ms({100, 104, 200}), at_ms({90, 105, 300}), 0.02), (Pairs{{100, 90}, {104, 105}}));
}

TEST(PosePairs, LimitTheGapInclusively) {
  EXPECT_EQ(pairs_ms(at_ms({100}), at_ms({120}), 0.02), (Pairs{{100, 120}}));
  EXPECT_EQ(pairs_ms(at_ms({100}), at_ms({121}), 0.02), Pairs{});
  EXPECT_EQ(pairs_ms(at_ms({100, 200}), at_ms({200}), 0.0), (Pairs{{200, 200}}));
}

TEST(PosePairs, OfNothingAreNothing) {
  EXPECT_TRUE(pair_poses({}, at_ms({1}), 1.0).empty());
  EXPECT_THROW((void)pair_poses({}, {}, -1.0), PreconditionError);
}

}  // namespace
}  // namespace cairn
