// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/association.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

using Stamps = std::vector<std::int64_t>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// The pair with the smallest gap, then the earliest, again and again.
Pairs associate_by_brute_force(const Stamps& a, const Stamps& b, std::int64_t max_gap) {
  std::vector<bool> a_used(a.size()), b_used(b.size());
  Pairs pairs;
  while (true) {
    std::int64_t smallest = max_gap + 1;
    std::pair<std::size_t, std::size_t> best;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        const std::int64_t gap = std::abs(a[i] - b[j]);
        if (a_used[i] || b_used[j] || gap >= smallest) continue;
        smallest = gap;
        best = {i, j};
      }
    }
    if (smallest > max_gap) break;
    a_used[best.first] = b_used[best.second] = true;
    pairs.push_back(best);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Stamps random_stamps(Random& random, std::uint32_t max_step) {
  Stamps stamps(random.index(25));
  std::int64_t stamp = random.index(20);
  for (auto& value : stamps) value = stamp += 1 + random.index(max_step);
  return stamps;
}

TEST(AssociateStamps, takes_the_nearest) {
  EXPECT_EQ(associate_stamps(Stamps{100, 200}, Stamps{90, 105, 197}, 20), (Pairs{{0, 1}, {1, 2}}));
}

TEST(AssociateStamps, uses_each_stamp_once) {
  EXPECT_EQ(associate_stamps(Stamps{100, 104}, Stamps{103}, 20), (Pairs{{1, 0}}));
  EXPECT_EQ(associate_stamps(Stamps{100, 104}, Stamps{95, 103}, 20), (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateStamps, ties_go_to_the_earlier) {
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{95, 105}, 20), (Pairs{{0, 0}}));
  EXPECT_EQ(associate_stamps(Stamps{95, 105}, Stamps{100}, 20), (Pairs{{0, 0}}));
}

TEST(AssociateStamps, the_gap_itself_is_allowed) {
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{120}, 20).size(), 1U);
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{80}, 20).size(), 1U);
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{121}, 20).size(), 0U);
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{100}, 0).size(), 1U);
  EXPECT_EQ(associate_stamps(Stamps{100}, Stamps{100}, -1).size(), 0U);
}

TEST(AssociateStamps, nothing_with_nothing) {
  EXPECT_TRUE(associate_stamps(Stamps{}, Stamps{1}, 5).empty());
  EXPECT_TRUE(associate_stamps(Stamps{1}, Stamps{}, 5).empty());
}

TEST(AssociateStamps, agrees_with_brute_force) {
  Random random(17);
  for (int round = 0; round < 400; ++round) {
    const Stamps a = random_stamps(random, 12), b = random_stamps(random, 9);
    const std::int64_t max_gap = random.index(30);
    ASSERT_EQ(associate_stamps(a, b, max_gap), associate_by_brute_force(a, b, max_gap)) << round;
  }
}

TEST(AssociateStamps, holds_at_the_ends_of_time) {
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(associate_stamps(Stamps{kFirst, kLast}, Stamps{kFirst + 1, kLast - 1}, 5),
            (Pairs{{0, 0}, {1, 1}}));
  EXPECT_TRUE(associate_stamps(Stamps{kFirst}, Stamps{kLast}, kLast).empty());
}

TEST(AssociateStamps, stamps_have_to_increase) {
  EXPECT_THROW((void)associate_stamps(Stamps{1, 1}, Stamps{1}, 5), PreconditionError);
  EXPECT_THROW((void)associate_stamps(Stamps{1}, Stamps{2, 1}, 5), PreconditionError);
}

}  // namespace
}  // namespace cairn
