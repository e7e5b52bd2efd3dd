// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cairn/map/indicators.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/uvlist.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::scene_covariances;
using testkit::scene_map;
using testkit::TemporaryFolder;

const Distribution& indicator(const MapStatistics& figures, const std::string& name) {
  const auto found = std::find_if(figures.indicators.begin(), figures.indicators.end(),
                                  [&](const IndicatorDistribution& any) { return any.name == name; });
  EXPECT_NE(found, figures.indicators.end()) << name;
  return found->values;
}

TEST(MapStatistics, counts_what_the_map_holds) {
  const TemporaryFolder folder;
  write_map(folder.path() / "map", scene_map());
  const MapStatistics figures = read_map_statistics(folder.path() / "map");
  EXPECT_EQ(figures.info.landmarks, 8U);
  EXPECT_EQ(figures.component_keyframes, (std::map<std::int32_t, std::size_t>{{0, 2}, {1, 2}}));
  EXPECT_EQ(figures.most_observations, 3U);
  EXPECT_EQ(figures.without_covariance, 8U);
  EXPECT_EQ(indicator(figures, "frames").count(), 8U);
  EXPECT_EQ(indicator(figures, "frames").max(), 3);
  EXPECT_EQ(indicator(figures, "std_x").count(), 0U);
  EXPECT_EQ(indicator(figures, "largest_std").count(), 0U);
  EXPECT_GT(indicator(figures, "rms_px").min(), 0);
}

TEST(MapStatistics, has_each_indicator_in_the_order_of_the_table) {
  const TemporaryFolder folder;
  const Map map = scene_map();
  const std::vector<Eigen::Matrix3d> covariances = scene_covariances(map);
  write_map(folder.path() / "map", map, covariances);
  const MapStatistics figures = read_map_statistics(folder.path() / "map");
  std::vector<std::string> names = uvlist_columns();
  names.erase(names.begin(), names.begin() + 4);
  names.insert(names.begin() + 4, "largest_std");
  ASSERT_EQ(figures.indicators.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(figures.indicators[i].name, names[i]);
  EXPECT_EQ(figures.without_covariance, 0U);
  double largest_z = 0, largest = 0;
  for (const LandmarkId id : map.landmark_ids()) {
    const Eigen::Matrix3d& covariance = covariances[id.index()];
    largest_z = std::max(largest_z, std::sqrt(covariance(2, 2)));
    largest = std::max(largest, largest_std(covariance));
  }
  EXPECT_NEAR(indicator(figures, "std_z").max(), largest_z, 1e-5);
  EXPECT_DOUBLE_EQ(indicator(figures, "largest_std").max(), largest);
  const Distribution& depth = indicator(figures, "mean_depth");
  EXPECT_LE(indicator(figures, "min_depth").min(), depth.min());
  EXPECT_GE(indicator(figures, "max_depth").max(), depth.max());
}

}  // namespace
}  // namespace cairn
