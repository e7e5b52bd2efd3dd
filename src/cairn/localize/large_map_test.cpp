// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

#include "cairn/core/stopwatch.h"
#include "cairn/localize/test_world.h"

namespace cairn {
namespace {

using test::World;

/// What the process has in memory now, MB.
double memory_mb() {
  std::ifstream status("/proc/self/statm");
  double pages = 0, resident = 0;
  status >> pages >> resident;
  return resident * 4096 / 1e6;
}

struct QueryTimes {
  double first = 0, again = 0;  ///< medians, seconds: where nothing of the place was touched before, and then
};

/// Images along the street, which are found.
QueryTimes time_queries(const World& world, const MapView& map, double length) {
  constexpr std::size_t kQueries = 60;
  const Localizer localizer(map, test::query_camera(), LocalizeOptions());
  std::vector<double> times[2];
  for (std::vector<double>& of_round : times) {
    for (std::size_t i = 0; i < kQueries; ++i) {
      const double x = 5 + (length - 20) * static_cast<double>(i) / kQueries;
      const auto view = world.see(World::pose_at(x, 0.2, 0.03), 1'000'000 + i, true, 1000);
      const Stopwatch watch;
      EXPECT_EQ(localizer.localize(view.frame).verdict, Verdict::good) << x;
      of_round.push_back(watch.seconds());
    }
    std::nth_element(of_round.begin(), of_round.begin() + kQueries / 2, of_round.end());
  }
  return {times[0][kQueries / 2], times[1][kQueries / 2]};
}

World::Options street(double length) {
  World::Options options;
  options.length = length;
  options.points = static_cast<std::size_t>(50 * length);
  options.keyframes = static_cast<int>(length / 3);
  options.features = 800;
  return options;
}

TEST(LargeMapSlow, a_million_landmarks_are_opened_at_once_and_searched_as_fast) {
  const test::Folder folder;
  constexpr double kShort = 200, kLong = 20'500;
  const World small(street(kShort)), large(street(kLong));
  small.write_map(folder.path() / "small");
  large.write_map(folder.path() / "large");
  const QueryTimes small_times = time_queries(small, MapView(folder.path() / "small"), kShort);
  const double before_mb = memory_mb();
  const Stopwatch watch;
  const MapView map(folder.path() / "large");
  const double open_seconds = watch.seconds();
  EXPECT_GE(map.info().landmarks, 1'000'000U);
  EXPECT_LT(open_seconds, 0.2);
  const QueryTimes large_times = time_queries(large, map, kLong);
  EXPECT_LT(memory_mb() - before_mb, 1000);
  EXPECT_LT(large_times.again, 2 * small_times.again);
  std::printf(
      "[          ] %u landmarks, opened in %.3f s, %.0f MB; a query takes %.1f ms at first, then %.1f ms "
      "(%.1f "
      "and %.1f ms in a map of a hundredth)\n",
      map.info().landmarks, open_seconds, memory_mb() - before_mb, 1e3 * large_times.first,
      1e3 * large_times.again, 1e3 * small_times.first, 1e3 * small_times.again);
}

}  // namespace
}  // namespace cairn
