// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/uniform_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/random.h"

namespace cairn {
namespace {

/// The first nine tenths are in the upper left quarter.
std::vector<PixelPosition> crowd(std::size_t count) {
  Random random(1);
  std::vector<PixelPosition> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double side = i < count * 9 / 10 ? 100 : 200;
    places.push_back(
        {static_cast<float>(random.uniform(0, side)), static_cast<float>(random.uniform(0, side))});
  }
  return places;
}

TEST(SelectSpread, keeps_all_where_all_are_wanted) {
  const auto places = crowd(20);
  EXPECT_EQ(select_uniform(places, 200, 200, 20).size(), 20U);
  EXPECT_EQ(select_uniform(places, 200, 200, 1000).size(), 20U);
  EXPECT_TRUE(select_uniform({}, 200, 200, 10).empty());
  EXPECT_TRUE(select_uniform(places, 200, 200, 0).empty());
}

TEST(SelectSpread, leaves_room_for_the_lonely_and_keeps_the_strongest) {
  const auto places = crowd(2000);
  const auto selected = select_uniform(places, 200, 200, 200);
  ASSERT_EQ(selected.size(), 200U);
  EXPECT_TRUE(std::is_sorted(selected.begin(), selected.end()));
  const auto lonely = std::count_if(selected.begin(), selected.end(),
                                    [&](std::size_t i) { return places[i].u >= 100 || places[i].v >= 100; });
  EXPECT_GE(lonely, 5 * 11);  // five of nine cells have nothing else, and half the count is 11 for each
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(selected[i], i);
}

TEST(SelectSpread, one_place_may_have_all) {
  const std::vector<PixelPosition> same(50, PixelPosition{10, 10});
  EXPECT_EQ(select_uniform(same, 100, 100, 3), (std::vector<std::size_t>{0, 1, 2}));
}

}  // namespace
}  // namespace cairn
