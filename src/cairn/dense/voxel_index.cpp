// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/voxel_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr int kFirstSlotBits = 8;

}  // namespace

VoxelKey voxel_in_block(BlockKey block, std::uint32_t local) {
  constexpr int kBits = kVoxelBits - kBlockBits;
  constexpr BlockKey kBlockMask = (BlockKey{1} << kBits) - 1;
  constexpr std::uint32_t kLocalMask = (1U << kBlockBits) - 1;
  VoxelKey voxel;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto high = static_cast<std::uint32_t>(block >> (axis * kBits) & kBlockMask);
    voxel[axis] = high << kBlockBits | (local >> (axis * kBlockBits) & kLocalMask);
  }
  return voxel;
}

void require_on_grid(const Eigen::Vector3d& centre, double reach, double voxel_size, double span) {
  const double limit = voxel_size * (span / 2 - 1);
  const double farthest = centre.cwiseAbs().maxCoeff() + reach;
  if (farthest <= limit) return;
  throw InputError({"coordinates", 0,
                    fmt::format("all within {:.0f} m of the origin, with voxels of {} m", limit, voxel_size),
                    fmt::format("a point up to {:.0f} m away, at ({:.0f}, {:.0f}, {:.0f})", farthest,
                                centre.x(), centre.y(), centre.z()),
                    "Move the origin near the points, or choose larger voxels."});
}

BlockIndex::BlockIndex()
    : shift_(64 - kFirstSlotBits), slots_(std::size_t{1} << kFirstSlotBits, std::uint32_t{kNone}) {}

std::uint32_t BlockIndex::find_or_insert(BlockKey key) {
  std::size_t slot = slot_of(key);
  if (slots_[slot] != kNone) return slots_[slot];
  if (2 * (keys_.size() + 1) > slots_.size()) {
    grow();
    slot = slot_of(key);
  }
  const auto number = static_cast<std::uint32_t>(keys_.size());
  slots_[slot] = number;
  keys_.push_back(key);
  return number;
}

void BlockIndex::grow() {
  --shift_;
  slots_.assign(2 * slots_.size(), kNone);
  for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = static_cast<std::uint32_t>(i);
}

std::vector<std::uint32_t> BlockIndex::sorted() const {
  std::vector<std::uint32_t> numbers(keys_.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::sort(numbers.begin(), numbers.end(), [&](auto a, auto b) { return keys_[a] < keys_[b]; });
  return numbers;
}

}  // namespace cairn
