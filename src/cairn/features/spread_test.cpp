// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// Nine tenths of the candidates, and the strongest, are in the upper left quarter.
std::vector<Candidate> crowd(std::size_t count) {
  Random random(1);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < count; ++i) {
    const bool crowded = i % 10 != 0;
    const double side = crowded ? 100 : 200;
    candidates.push_back({static_cast<float>(random.uniform(0, side)),
                          static_cast<float>(random.uniform(0, side)),
                          static_cast<float>(random.uniform() + (crowded ? 1 : 0))});
  }
  return candidates;
}

int in_crowd(const std::vector<Candidate>& candidates, const std::vector<std::int32_t>& chosen) {
  return static_cast<int>(std::count_if(chosen.begin(), chosen.end(), [&](std::int32_t i) {
    const Candidate& c = candidates[static_cast<std::size_t>(i)];
    return c.u < 100 && c.v < 100;
  }));
}

TEST(SelectSpread, keeps_all_where_all_are_wanted) {
  const auto candidates = crowd(20);
  EXPECT_EQ(select_spread(candidates, 20, 200, 200).size(), 20U);
  EXPECT_EQ(select_spread(candidates, 1000, 200, 200).size(), 20U);
  EXPECT_TRUE(select_spread({}, 10, 200, 200).empty());
  EXPECT_TRUE(select_spread(candidates, 0, 200, 200).empty());
}

TEST(SelectSpread, takes_the_strongest_where_there_is_no_limit_on_a_cell) {
  const auto candidates = crowd(1000);
  const auto chosen = select_spread(candidates, 100, 200, 200, 1e6);
  float weakest_chosen = 10;
  for (const std::int32_t i : chosen)
    weakest_chosen = std::min(weakest_chosen, candidates[static_cast<std::size_t>(i)].strength);
  const auto stronger = std::count_if(candidates.begin(), candidates.end(),
                                      [&](const Candidate& c) { return c.strength > weakest_chosen; });
  EXPECT_EQ(stronger, 99);
}

TEST(SelectSpread, leaves_room_for_the_lonely) {
  const auto candidates = crowd(2000);
  const auto even = select_spread(candidates, 200, 200, 200, 1);
  const auto strong = select_spread(candidates, 200, 200, 200, 1e6);
  EXPECT_EQ(even.size(), 200U);
  EXPECT_EQ(in_crowd(candidates, strong), 200);
  EXPECT_LT(in_crowd(candidates, even), 100);
  EXPECT_TRUE(std::is_sorted(even.begin(), even.end()));
}

TEST(SelectSpread, ties_go_to_the_lower_position) {
  const std::vector<Candidate> same(50, Candidate{10, 10, 1});
  EXPECT_EQ(select_spread(same, 3, 100, 100), (std::vector<std::int32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace cairn
