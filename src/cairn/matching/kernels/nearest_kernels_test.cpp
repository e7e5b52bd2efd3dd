// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/nearest_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

/// Few different values, so that most are tied; some are missing.
std::vector<std::int32_t> random_distances(std::size_t count, std::uint32_t values, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::int32_t> distances(count);
  for (auto& distance : distances)
    distance = random.index(10) == 0 ? kNoDistance : static_cast<std::int32_t>(random.index(values));
  return distances;
}

/// By sorting.
TwoSmallest slow_two_smallest(const std::vector<std::int32_t>& distances) {
  std::vector<std::int32_t> places(distances.size());
  std::iota(places.begin(), places.end(), 0);
  const auto at = [&](std::int32_t i) { return distances[static_cast<std::size_t>(i)]; };
  std::stable_sort(places.begin(), places.end(), [&](auto a, auto b) { return at(a) < at(b); });
  TwoSmallest two;
  if (at(places[0]) != kNoDistance) two.first = at(places[0]), two.first_at = places[0];
  if (at(places[1]) != kNoDistance) two.second = at(places[1]), two.second_at = places[1];
  return two;
}

class NearestKernelsTest : public testing::TestWithParam<InstructionSet> {
 protected:
  const NearestKernels& kernels_ = nearest_kernels(GetParam());
};

TEST_P(NearestKernelsTest, finds_the_two_smallest_and_lower_places_first) {
  for (const std::size_t count : {16U, 32U, 48U, 1008U}) {
    for (const std::uint32_t values : {1U, 3U, 50U, 100000U}) {
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto distances = random_distances(count, values, seed);
        const TwoSmallest expected = slow_two_smallest(distances);
        const TwoSmallest two = kernels_.two_smallest(distances.data(), count);
        const TwoSmallest one = kernels_.smallest(distances.data(), count);
        ASSERT_EQ(two.first, expected.first);
        ASSERT_EQ(two.first_at, expected.first_at);
        ASSERT_EQ(two.second, expected.second);
        ASSERT_EQ(two.second_at, expected.second_at);
        ASSERT_EQ(one.first, expected.first);
        ASSERT_EQ(one.first_at, expected.first_at);
        ASSERT_EQ(one.second_at, -1);
      }
    }
  }
}

TEST_P(NearestKernelsTest, finds_nothing_where_nothing_is) {
  const std::vector<std::int32_t> none(16, kNoDistance);
  EXPECT_EQ(kernels_.smallest(none.data(), 16).first_at, -1);
  EXPECT_EQ(kernels_.two_smallest(none.data(), 16).first_at, -1);
  EXPECT_EQ(kernels_.two_smallest(none.data(), 0).second_at, -1);
}

TEST_P(NearestKernelsTest, keeps_the_first_of_the_smallest_rows) {
  constexpr std::size_t kRows = 11, kColumns = 48, kCut = 4;  // in two calls
  const auto distances = random_distances(kRows * kColumns, 4, 1);
  std::vector<std::int32_t> best(kColumns, kNoDistance), rows(kColumns, -1);
  kernels_.update_columns(distances.data(), kCut, kColumns, 100, {best.data(), rows.data()});
  kernels_.update_columns(distances.data() + kCut * kColumns, kRows - kCut, kColumns, 100 + kCut,
                          {best.data(), rows.data()});
  for (std::size_t c = 0; c < kColumns; ++c) {
    std::int32_t expected = kNoDistance, expected_row = -1;
    for (std::size_t r = 0; r < kRows; ++r) {
      if (distances[r * kColumns + c] >= expected) continue;
      expected = distances[r * kColumns + c];
      expected_row = static_cast<std::int32_t>(100 + r);
    }
    ASSERT_EQ(best[c], expected);
    ASSERT_EQ(rows[c], expected_row);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, NearestKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
