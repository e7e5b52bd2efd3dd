// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/occupancy.h"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <array>
#include <map>

#include "cairn/core/error.h"
#include "cairn/testing/dense/occupancy_scene.h"
#include "cairn/testing/image/depth_scene.h"

namespace cairn {
namespace {

using testkit::map_scene;

using Voxels = std::map<std::array<int, 3>, float>;

Voxels voxels_of(const OccupancyGrid& grid) {
  Voxels voxels;
  grid.visit_sorted([&](const OccupancyVoxel& voxel) {
    voxels[{voxel.position.x(), voxel.position.y(), voxel.position.z()}] = voxel.log_odds;
  });
  return voxels;
}

template <class Tree>
Voxels voxels_of(const Tree& tree) {
  Voxels voxels;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto key = leaf.getKey();
    voxels[{key[0] - 32768, key[1] - 32768, key[2] - 32768}] = leaf->getLogOdds();
  }
  return voxels;
}

TEST(OccupancyGrid, TheSameVoxelsAndLogOddsAsOctomap) {
  const Voxels ours = voxels_of(map_scene(1)), theirs = voxels_of(*testkit::map_scene_with_octomap());
  EXPECT_GT(ours.size(), 10000U);
  EXPECT_EQ(ours, theirs);  // to the bit: same traversal, same order, same arithmetic
}

TEST(OccupancyGrid, TheSameAtAnyNumberOfThreads) {
  const Voxels one = voxels_of(map_scene(1));
  EXPECT_EQ(voxels_of(map_scene(2)), one);
  EXPECT_EQ(voxels_of(map_scene(4)), one);
}

TEST(OccupancyGrid, AHitIsOccupiedTheWayToItIsFree) {
  DepthImage depth(64, 48);
  depth(32, 24) = 1.0F;
  RgbImage color(64, 48, {10, 20, 30});
  Camera camera = testkit::small_camera();
  camera.cx = 32;
  camera.cy = 24;
  OccupancyGrid grid({.resolution = 0.1});
  const Rigid3 pose{Eigen::Quaterniond::Identity(), {0.05, 0.05, 0.05}};
  grid.apply(grid.scan(depth, color, PixelRays(camera), pose));
  EXPECT_EQ(grid.counts().occupied, 1);
  EXPECT_EQ(grid.counts().free, 10);
  grid.visit_sorted([](const OccupancyVoxel& voxel) {
    EXPECT_EQ(voxel.position.head<2>(), Eigen::Vector2i(0, 0));
    EXPECT_EQ(voxel.occupied, voxel.position.z() == 10);
    EXPECT_EQ(voxel.color, voxel.occupied ? (Rgb8{10, 20, 30}) : Rgb8{});
  });
}

TEST(OccupancyGrid, BeyondMaxRangeNothingIsHit) {
  DepthImage depth(64, 48, 6.0F);
  OccupancyGrid grid({.max_range = 3.0});
  grid.apply(grid.scan(depth, {}, PixelRays(testkit::small_camera()), Rigid3{}));
  EXPECT_EQ(grid.counts().occupied, 0);
  EXPECT_GT(grid.counts().free, 1000);
  grid.visit_sorted([](const OccupancyVoxel& voxel) {
    EXPECT_LT(0.05 * voxel.position.cast<double>().norm(), 3.0 + 0.05 * 2);
  });
}

TEST(OccupancyGrid, ACloudWithoutViewpointsFreesNothing) {
  const Cloud cloud = {
      {{0.01F, 0.01F, 0.01F, 10, 0, 0}, {0.02F, 0.02F, 0.02F, 20, 0, 0}, {-0.01F, 1, 1, 7, 8, 9}}};
  OccupancyGrid grid;
  grid.add_cloud(cloud);
  EXPECT_EQ(grid.counts().occupied, 2);
  EXPECT_EQ(grid.counts().free, 0);
  EXPECT_TRUE(grid.colored());
}

TEST(OccupancyOptions, NameTheFieldThatIsWrong) {
  try {
    OccupancyGrid({.resolution = 0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "octree.resolution: expected metres above 0, up to 1000, found 0.\n  Leave it out for the default.");
  }
  EXPECT_THROW(OccupancyGrid({.max_range = -1}), InputError);
  EXPECT_THROW(OccupancyGrid({.hit = 0.4}), InputError);
  EXPECT_THROW(OccupancyGrid({.miss = 0.6}), InputError);
}

}  // namespace
}  // namespace cairn
