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

/// Median of the time of a query, seconds; they are found.
double time_queries(const World& world, const MapView& map, double length) {
  const Localizer localizer(map, test::query_camera(), LocalizeOptions());
  std::vector<double> times;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const double x = 5 + (length - 20) * static_cast<double>(i) / 60;
    const auto view = world.see(World::pose_at(x, 0.2, 0.03), 1'000'000 + i, true, 1000);
    const Stopwatch watch;
    EXPECT_EQ(localizer.localize(view.frame).verdict, Verdict::good) << x;
    times.push_back(watch.seconds());
  }
  std::nth_element(times.begin(), times.begin() + 30, times.end());
  return times[30];
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
  const double small_seconds = time_queries(small, MapView(folder.path() / "small"), kShort);
  const double before_mb = memory_mb();
  const Stopwatch watch;
  const MapView map(folder.path() / "large");
  const double open_seconds = watch.seconds();
  EXPECT_GE(map.info().landmarks, 1'000'000U);
  EXPECT_LT(open_seconds, 0.2);
  const double large_seconds = time_queries(large, map, kLong);
  EXPECT_LT(memory_mb() - before_mb, 1000);
  EXPECT_LT(large_seconds, 2 * small_seconds);
  std::printf("[          ] %u landmarks, opened in %.3f s, %.1f ms a query (small map: %.1f ms), %.0f MB\n",
              map.info().landmarks, open_seconds, 1e3 * large_seconds, 1e3 * small_seconds,
              memory_mb() - before_mb);
}

}  // namespace
}  // namespace cairn
