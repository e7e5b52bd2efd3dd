// SPDX-License-Identifier: Apache-2.0
// That whole images meet the voxels that OctoMap's rays meet is tested in occupancy_test.cpp.
#include "cairn/dense/ray_walk.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <set>

#include "cairn/core/random.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn {
namespace {

using Voxel = std::array<int, 3>;

/// Returns the voxels of a mask, by their coordinates.
std::set<Voxel> voxels_in(const OccupancyUpdate& update, BlockMask OccupancyUpdate::Masks::*mask) {
  std::set<Voxel> voxels;
  for (std::uint32_t block = 0; block < update.blocks.size(); ++block) {
    for (std::uint32_t local = 0; local < kVoxelsPerBlock; ++local) {
      if (((update.blocks[block].*mask)[local >> 6U] >> (local & 63U) & 1U) == 0) continue;
      const VoxelKey key = voxel_in_block(update.index.key(block), local);
      Voxel voxel;
      for (std::size_t i = 0; i < 3; ++i) voxel[i] = static_cast<int>(key[i]) - kVoxelOffset;
      voxels.insert(voxel);
    }
  }
  return voxels;
}

std::set<Voxel> passed(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  OccupancyUpdate update;
  RayWalk(from, 0.1, update).pass_to(to);
  return voxels_in(update, &OccupancyUpdate::Masks::passed);
}

TEST(RayWalk, passes_from_the_first_voxel_to_the_one_before_the_last) {
  std::set<Voxel> expected;
  for (int x = -9; x < 10; ++x) expected.insert({x, 0, 0});  // over the borders of blocks
  EXPECT_EQ(passed({-0.85F, 0.05F, 0.05F}, {1.05F, 0.05F, 0.05F}), expected);
}

TEST(RayWalk, passes_nothing_within_one_voxel) {
  EXPECT_TRUE(passed({0.01F, 0.01F, 0.01F}, {0.09F, 0.09F, 0.09F}).empty());
}

TEST(RayWalk, steps_to_a_neighbour_through_what_the_ray_crosses) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f from = testkit::normal_vector(random).cast<float>();
    const Eigen::Vector3f to = testkit::normal_vector(random).cast<float>();
    const std::set<Voxel> voxels = passed(from, to);
    OccupancyUpdate unused;
    const RayWalk walk(from, 0.1, unused);
    const VoxelKey first = walk.voxel_at(from), last = walk.voxel_at(to);
    std::size_t steps = 0;  // one for each border between the ends
    for (std::size_t axis = 0; axis < 3; ++axis)
      steps += std::max(first[axis], last[axis]) - std::min(first[axis], last[axis]);
    EXPECT_EQ(voxels.size(), steps) << i;
    const Eigen::Vector3d way = (to - from).cast<double>().normalized();
    for (const Voxel& voxel : voxels) {
      const Eigen::Vector3d centre = 0.1 * (Eigen::Vector3d(voxel[0], voxel[1], voxel[2]).array() + 0.5);
      const Eigen::Vector3d aside = centre - from.cast<double>();
      EXPECT_LT((aside - aside.dot(way) * way).norm(), 0.5 * 0.1 * 1.7321 + 1e-6) << i;
    }
  }
}

TEST(RayWalk, a_hit_marks_one_voxel) {
  OccupancyUpdate update;
  RayWalk walk({0, 0, 0}, 0.1, update);
  const std::uint32_t block = walk.hit(walk.voxel_at({-0.05F, 0.25F, 0.95F}));
  EXPECT_EQ(block, update.blocks.size() - 1);
  EXPECT_EQ(voxels_in(update, &OccupancyUpdate::Masks::hit), (std::set<Voxel>{{-1, 2, 9}}));
  EXPECT_TRUE(voxels_in(update, &OccupancyUpdate::Masks::passed).empty());
}

TEST(RayWalk, the_middle_of_a_voxel_lies_in_it) {
  OccupancyUpdate update;
  const RayWalk walk({0, 0, 0}, 0.1, update);
  const Eigen::Vector3f centre = walk.centre_of(walk.voxel_at({-0.01F, 0.01F, 1.23F}));
  EXPECT_TRUE(centre.isApprox(Eigen::Vector3f(-0.05F, 0.05F, 1.25F))) << centre.transpose();
}

}  // namespace
}  // namespace cairn
