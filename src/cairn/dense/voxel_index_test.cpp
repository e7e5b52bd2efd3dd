// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/voxel_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

TEST(VoxelIndex, BlockAndLocalNumberGiveTheVoxelBack) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const VoxelKey voxel = {random.index(1U << kVoxelBits), random.index(1U << kVoxelBits),
                            random.index(1U << kVoxelBits)};
    EXPECT_EQ(voxel_in_block(block_of(voxel), local_of(voxel)), voxel);
  }
}

TEST(VoxelIndex, NumbersAreThoseOfTheFirstMeeting) {
  Random random(2);
  BlockIndex index;
  std::map<BlockKey, std::uint32_t> known;
  for (int i = 0; i < 20000; ++i) {
    const BlockKey key = random.index(5000) * 977ULL;
    const auto [place, is_new] = known.emplace(key, static_cast<std::uint32_t>(known.size()));
    EXPECT_EQ(index.find(key), is_new ? BlockIndex::kNone : place->second);
    EXPECT_EQ(index.find_or_insert(key), place->second);
  }
  ASSERT_EQ(index.size(), known.size());
  const auto sorted = index.sorted();
  EXPECT_TRUE(std::is_sorted(sorted.begin(), sorted.end(),
                             [&](auto a, auto b) { return index.key(a) < index.key(b); }));
}

TEST(VoxelIndex, FarCoordinatesAreAnInputError) {
  EXPECT_NO_THROW(require_on_grid({1000, 0, 0}, 10, 0.01, 1 << 21));
  try {
    require_on_grid({0, 11000, 0}, 10, 0.01, 1 << 21);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "coordinates: expected all within 10486 m of the origin, with voxels of 0.01 m, found a point up "
        "to 11010 m away, at (0, 11000, 0).\n  Move the origin near the points, or choose larger voxels.");
  }
}

}  // namespace
}  // namespace cairn
