// SPDX-License-Identifier: Apache-2.0
// How much work a large map makes: what is read of it and how many descriptors are compared. How long that
// takes is measured in benchmarks/map_queries.cpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/localize/street_world.h"

namespace cairn {
namespace {

using testkit::StreetWorld;

constexpr double kShort = 200, kLong = 20'500;  // metres of street
constexpr std::uint64_t kQueries = 60;

/// What the process has in memory now, MB.
double memory_mb() {
  std::ifstream status("/proc/self/statm");
  double pages = 0, resident = 0;
  status >> pages >> resident;
  return resident * 4096 / 1e6;
}

std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

StreetWorld::Options street(double length) {
  StreetWorld::Options options;
  options.length = length;
  options.points = static_cast<std::size_t>(50 * length);
  options.keyframes = static_cast<int>(length / 3);
  options.features = 800;
  return options;
}

/// Looks for images along the street, which are found.
void find_images(const StreetWorld& world, const StoredMap& map, double length) {
  const Localizer localizer(map, testkit::street_query_camera(), LocalizeOptions());
  for (std::uint64_t i = 0; i < kQueries; ++i) {
    const double x = 5 + (length - 20) * static_cast<double>(i) / static_cast<double>(kQueries);
    const auto view = world.see(StreetWorld::pose_at(x, 0.2, 0.03), 1'000'000 + i, true, 1000);
    EXPECT_EQ(localizer.localize(view.frame).verdict, Verdict::good) << x;
  }
}

TEST(LargeMapSlow, a_query_of_a_million_landmarks_is_little_more_work_than_of_ten_thousand) {
  const testkit::TemporaryFolder folder;
  const StreetWorld small(street(kShort)), large(street(kLong));
  small.write_map(folder.path() / "small");
  large.write_map(folder.path() / "large");
  const StoredMap small_map(folder.path() / "small");
  find_images(small, small_map, kShort);
  const double before_mb = memory_mb();
  const StoredMap map(folder.path() / "large");
  const std::uint64_t all = bytes_in(folder.path() / "large"), opened = map.touched_bytes();
  EXPECT_GE(map.info().landmarks, 1'000'000U);
  EXPECT_LT(opened, all / 20);
  find_images(large, map, kLong);
  EXPECT_LT(map.touched_bytes(), all / 4);
  EXPECT_LT(4 * map.places().compared_rows(), 5 * small_map.places().compared_rows());
  EXPECT_LT(memory_mb() - before_mb, 1000);
  std::printf(
      "[          ] %u landmarks, %.0f MB, of which %.1f MB are read on opening and %.1f MB after %d "
      "queries, "
      "%.0f MB of memory; a query compares %.0f descriptors (%.0f in a map of a hundredth)\n",
      map.info().landmarks, 1e-6 * static_cast<double>(all), 1e-6 * static_cast<double>(opened),
      1e-6 * static_cast<double>(map.touched_bytes()), static_cast<int>(kQueries), memory_mb() - before_mb,
      static_cast<double>(map.places().compared_rows()) / static_cast<double>(kQueries),
      static_cast<double>(small_map.places().compared_rows()) / static_cast<double>(kQueries));
}

}  // namespace
}  // namespace cairn
