// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/occupancy.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <map>
#include <memory>
#include <sstream>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"
#include "cairn/core/file.h"
#include "cairn/dense/octree_file.h"
#include "cairn/dense/test_scene.h"

namespace cairn {
namespace {

using test_scene::color_image;
using test_scene::depth_image;
using test_scene::world_from_camera;

constexpr int kFrames = 10;

OccupancyGrid build(int threads, bool colored = true) {
  const PixelRays rays(test_scene::small_camera());
  OccupancyGrid grid;
  const Executor executor(threads);
  executor.ordered_pipeline<OccupancyUpdate>(
      kFrames,
      [&](std::size_t i) {
        return grid.scan(depth_image(i), colored ? color_image() : RgbImage(), rays,
                         world_from_camera(static_cast<int>(i)));
      },
      [&](std::size_t, OccupancyUpdate&& update) {
        grid.apply(update);
        return true;
      });
  return grid;
}

/// octomap's own insertion of the same points.
octomap::OcTree build_with_octomap() {
  octomap::OcTree tree(0.05);
  const Camera camera = test_scene::small_camera();
  for (int frame = 0; frame < kFrames; ++frame) {
    const DepthImage depth = depth_image(static_cast<std::uint64_t>(frame));
    octomap::Pointcloud points;
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        if (!(depth(u, v) > 0)) continue;
        const Eigen::Vector3f point =
            (world_from_camera(frame) * *camera.back_project({u, v}, static_cast<double>(depth(u, v))))
                .cast<float>();
        points.push_back(point.x(), point.y(), point.z());
      }
    }
    const Eigen::Vector3f origin = world_from_camera(frame).translation.cast<float>();
    tree.insertPointCloud(points, {origin.x(), origin.y(), origin.z()}, 4.0, false, true);
  }
  tree.expand();
  return tree;
}

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

template <class Tree>
std::unique_ptr<Tree> read_tree(const std::filesystem::path& path) {
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(path.string()));
  return std::unique_ptr<Tree>(dynamic_cast<Tree*>(tree.release()));
}

TEST(OccupancyGrid, TheSameVoxelsAndLogOddsAsOctomap) {
  const Voxels ours = voxels_of(build(1)), theirs = voxels_of(build_with_octomap());
  EXPECT_GT(ours.size(), 10000U);
  EXPECT_EQ(ours, theirs);  // to the bit: same traversal, same order, same arithmetic
}

TEST(OccupancyGrid, TheSameAtAnyNumberOfThreads) {
  const Voxels one = voxels_of(build(1));
  EXPECT_EQ(voxels_of(build(2)), one);
  EXPECT_EQ(voxels_of(build(4)), one);
}

TEST(OccupancyGrid, AHitIsOccupiedTheWayToItIsFree) {
  DepthImage depth(64, 48);
  depth(32, 24) = 1.0F;
  RgbImage color(64, 48, {10, 20, 30});
  Camera camera = test_scene::small_camera();
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
  grid.apply(grid.scan(depth, {}, PixelRays(test_scene::small_camera()), Rigid3{}));
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

TEST(OctreeFile, ColouredTreeHoldsTheMap) {
  const OccupancyGrid grid = build(1);
  const auto path = test_scene::temporary_path("color.ot");
  const auto report = write_octree(path, grid, octree_contents(path, grid.colored()));
  EXPECT_EQ(report.bytes, static_cast<std::int64_t>(std::filesystem::file_size(path)));
  const auto tree = read_tree<octomap::ColorOcTree>(path);
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(static_cast<std::int64_t>(tree->size()), report.nodes);
  grid.visit_sorted([&](const OccupancyVoxel& voxel) {
    const Eigen::Vector3d centre = 0.05 * (voxel.position.cast<double>().array() + 0.5);
    const auto* node = tree->search(centre.x(), centre.y(), centre.z());
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->getLogOdds(), voxel.log_odds);
    EXPECT_EQ(tree->isNodeOccupied(node), voxel.occupied);
  });
}

TEST(OctreeFile, PlainTreeIsOctomapsOwn) {
  const OccupancyGrid grid = build(1, false);
  const auto path = test_scene::temporary_path("plain.ot");
  write_octree(path, grid, octree_contents(path, grid.colored()));
  const auto tree = read_tree<octomap::OcTree>(path);
  ASSERT_NE(tree, nullptr);
  octomap::OcTree theirs = build_with_octomap();
  theirs.prune();
  EXPECT_EQ(tree->size(), theirs.size());
  EXPECT_TRUE(*tree == theirs);
}

TEST(OctreeFile, BinaryTreeHoldsOccupiedAndFree) {
  const OccupancyGrid grid = build(1);
  const auto path = test_scene::temporary_path("binary.bt");
  write_octree(path, grid, octree_contents(path, grid.colored()));
  octomap::OcTree theirs = build_with_octomap();
  std::ostringstream their_bytes;
  theirs.writeBinary(their_bytes);
  EXPECT_EQ(read_file(path), their_bytes.str());
  octomap::OcTree tree(path.string());
  tree.expand();
  OccupancyGrid::Counts counts;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf)
    ++(tree.isNodeOccupied(*leaf) ? counts.occupied : counts.free);
  EXPECT_EQ(counts.occupied, grid.counts().occupied);
  EXPECT_EQ(counts.free, grid.counts().free);
}

TEST(OctreeFile, AnEmptyMapIsAFileThatOctomapReads) {
  const auto path = test_scene::temporary_path("empty.bt");
  write_octree(path, OccupancyGrid(), OctreeContents::binary);
  octomap::OcTree tree(0.1);
  EXPECT_TRUE(tree.readBinary(path.string()));
  EXPECT_EQ(tree.size(), 0U);
}

TEST(OctreeFile, AFolderThatIsNotThereIsAnInputError) {
  EXPECT_THROW(write_octree("/nowhere/at/all.bt", build(1), OctreeContents::binary), InputError);
}

TEST(OctreeFile, UnknownExtension) {
  EXPECT_EQ(octree_contents("a.bt", true), OctreeContents::binary);
  EXPECT_EQ(octree_contents("a.ot", true), OctreeContents::color);
  EXPECT_EQ(octree_contents("a.ot", false), OctreeContents::plain);
  EXPECT_THROW((void)octree_contents("a.ply", true), InputError);
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
