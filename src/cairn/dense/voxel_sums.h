// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/dense/pixel_rays.h"
#include "cairn/dense/voxel_index.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn {

/// Sums the points of one voxel. All sums are integers, so that they do not depend on the order of adding.
struct VoxelSum {
  std::uint32_t count = 0;
  std::uint32_t x = 0, y = 0, z = 0;  ///< offsets from the voxel's lower corner, in 1/1024 of its size
  std::uint32_t r = 0, g = 0, b = 0;
};

/// Holds voxels of one size, each with the sums of its points. Used for one frame and for a whole map; 28
/// bytes a voxel, 2 kB a block. A voxel stops summing at 2^22 points, when its mean has long settled.
class VoxelSums {
 public:
  /// `voxel_size` in metres, above 0.
  explicit VoxelSums(double voxel_size);

  /// Adds a depth image's points with depth in (min_depth, max_depth]. `color` is empty or of the same size.
  /// Throws InputError if points would lie outside the grid.
  void add_image(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                 const Rigid3& world_from_camera, double min_depth, double max_depth);
  /// Adds one point.
  void add_point(const Eigen::Vector3d& point_in_world, const Rgb8& color);
  /// Adds all voxels of a grid with the same voxel size.
  void add(const VoxelSums& other);

  [[nodiscard]] double voxel_size() const { return voxel_size_; }
  [[nodiscard]] std::size_t size() const { return size_; }  ///< voxels with points
  /// Calls visit(key, sum) for each voxel, in order of the block keys and of the voxels in a block.
  template <class Visit>
  void visit_sorted(const Visit& visit) const {
    for (const std::uint32_t block : index_.sorted()) visit_block(block, visit);
  }
  /// Returns the mean of a voxel's points, metres.
  [[nodiscard]] Eigen::Vector3d mean(const VoxelKey& key, const VoxelSum& sum) const;

 private:
  using Block = std::array<std::uint32_t, kVoxelsPerBlock>;  // number of each voxel's sum, or kNone
  struct Row;

  template <class Visit>
  void visit_block(std::uint32_t block, const Visit& visit) const {
    for (std::uint32_t local = 0; local < kVoxelsPerBlock; ++local) {
      const std::uint32_t number = (*blocks_[block])[local];
      if (number != BlockIndex::kNone) visit(voxel_in_block(index_.key(block), local), sum(number));
    }
  }
  [[nodiscard]] VoxelSum& sum(std::uint32_t number) const {
    return chunks_[number >> kChunkBits][number & ((1U << kChunkBits) - 1)];
  }
  [[nodiscard]] Block& block(BlockKey key);
  [[nodiscard]] VoxelSum& sum_in(Block& block, std::uint32_t local);
  void add_row(const Row& row, const Rgb8* color);

  static constexpr int kChunkBits = 12;
  double voxel_size_;
  std::size_t size_ = 0;
  BlockIndex index_;
  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<std::unique_ptr<VoxelSum[]>> chunks_;
};

/// Returns the mean colour, rounded; black for no points.
[[nodiscard]] Rgb8 mean_color(const VoxelSum& sum);

}  // namespace cairn
