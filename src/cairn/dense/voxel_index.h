// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Voxels are cubes of one size on a grid through the world's origin: voxel (0,0,0) spans [0, size) on every
/// axis. Each axis has 2^21 voxels, half of them below 0. They are stored in blocks of 8 x 8 x 8.
inline constexpr int kVoxelBits = 21;
inline constexpr int kBlockBits = 3;
inline constexpr int kVoxelsPerBlock = 1 << (3 * kBlockBits);
inline constexpr std::int32_t kVoxelOffset = 1 << (kVoxelBits - 1);  ///< stored = coordinate + offset, >= 0

/// A voxel's position on the grid, offset so that it is never negative.
using VoxelKey = std::array<std::uint32_t, 3>;
/// A block's position, 18 bits an axis, z highest: the order in which results are written.
using BlockKey = std::uint64_t;

/// Returns the block that holds a voxel.
[[nodiscard]] inline BlockKey block_of(const VoxelKey& voxel) {
  constexpr int kBits = kVoxelBits - kBlockBits;
  return static_cast<BlockKey>(voxel[2] >> kBlockBits) << (2 * kBits) |
         static_cast<BlockKey>(voxel[1] >> kBlockBits) << kBits | voxel[0] >> kBlockBits;
}

/// Returns the number of a voxel within its block, [0, 512), z highest.
[[nodiscard]] inline std::uint32_t local_of(const VoxelKey& voxel) {
  constexpr std::uint32_t kMask = (1U << kBlockBits) - 1;
  return (voxel[2] & kMask) << (2 * kBlockBits) | (voxel[1] & kMask) << kBlockBits | (voxel[0] & kMask);
}

/// Returns the voxel with number `local` in a block.
[[nodiscard]] VoxelKey voxel_in_block(BlockKey block, std::uint32_t local);

/// Throws InputError unless everything within `reach` metres of `centre` lies on a grid of `voxel_size`.
/// `span` is the number of voxels that an axis may have (2^21 here, 2^16 in an OctoMap file).
void require_on_grid(const Eigen::Vector3d& centre, double reach, double voxel_size, double span);

/// Numbers block keys from 0 in the order in which they are inserted; finds them by open addressing.
class BlockIndex {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  BlockIndex();
  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] BlockKey key(std::size_t number) const { return keys_[number]; }
  /// Returns the block's number, or kNone.
  [[nodiscard]] std::uint32_t find(BlockKey key) const { return slots_[slot_of(key)]; }
  /// Returns the block's number, which is `size() - 1` after a call with a new key.
  std::uint32_t find_or_insert(BlockKey key);
  /// Returns the numbers of all blocks in increasing order of their keys.
  [[nodiscard]] std::vector<std::uint32_t> sorted() const;

 private:
  [[nodiscard]] std::size_t slot_of(BlockKey key) const {
    std::size_t slot = (key * 0x9e3779b97f4a7c15ULL) >> shift_;  // Fibonacci hashing
    while (slots_[slot] != kNone && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow();

  int shift_;
  std::vector<std::uint32_t> slots_;
  std::vector<BlockKey> keys_;
};

}  // namespace cairn
