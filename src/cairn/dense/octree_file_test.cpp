// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/octree_file.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <sstream>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/dense/occupancy_scene.h"

namespace cairn {
namespace {

using testkit::map_scene;

template <class Tree>
std::unique_ptr<Tree> read_tree(const std::filesystem::path& path) {
  std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(path.string()));
  return std::unique_ptr<Tree>(dynamic_cast<Tree*>(tree.release()));
}

TEST(OctreeFile, ColouredTreeHoldsTheMap) {
  const OccupancyGrid grid = map_scene(1);
  const testkit::TemporaryFolder folder;
  const auto path = folder / "color.ot";
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
  const OccupancyGrid grid = map_scene(1, false);
  const testkit::TemporaryFolder folder;
  const auto path = folder / "plain.ot";
  write_octree(path, grid, octree_contents(path, grid.colored()));
  const auto tree = read_tree<octomap::OcTree>(path);
  ASSERT_NE(tree, nullptr);
  const auto theirs = testkit::map_scene_with_octomap();
  theirs->prune();
  EXPECT_EQ(tree->size(), theirs->size());
  EXPECT_TRUE(*tree == *theirs);
}

TEST(OctreeFile, BinaryTreeHoldsOccupiedAndFree) {
  const OccupancyGrid grid = map_scene(1);
  const testkit::TemporaryFolder folder;
  const auto path = folder / "binary.bt";
  write_octree(path, grid, octree_contents(path, grid.colored()));
  const auto theirs = testkit::map_scene_with_octomap();
  std::ostringstream their_bytes;
  theirs->writeBinary(their_bytes);
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
  const testkit::TemporaryFolder folder;
  const auto path = folder / "empty.bt";
  write_octree(path, OccupancyGrid(), OctreeContents::binary);
  octomap::OcTree tree(0.1);
  EXPECT_TRUE(tree.readBinary(path.string()));
  EXPECT_EQ(tree.size(), 0U);
}

TEST(OctreeFile, AFolderThatIsNotThereIsAnInputError) {
  EXPECT_THROW(write_octree("/nowhere/at/all.bt", map_scene(1), OctreeContents::binary), InputError);
}

TEST(OctreeFile, UnknownExtension) {
  EXPECT_EQ(octree_contents("a.bt", true), OctreeContents::binary);
  EXPECT_EQ(octree_contents("a.ot", true), OctreeContents::color);
  EXPECT_EQ(octree_contents("a.ot", false), OctreeContents::plain);
  EXPECT_THROW((void)octree_contents("a.ply", true), InputError);
}

}  // namespace
}  // namespace cairn
