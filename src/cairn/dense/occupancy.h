// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "cairn/core/parameter.h"
#include "cairn/dense/cloud.h"
#include "cairn/dense/voxel_index.h"
#include "cairn/dense/voxel_sums.h"

namespace cairn {

/// Sets the sensor model of Hornung et al. 2013 (OctoMap), section 3.2; the probabilities are OctoMap's
/// defaults.
struct OccupancyOptions {
  double resolution = 0.05;   ///< metres: half of the narrowest gap that a robot must tell from a wall
  double max_range = 4.0;     ///< metres from the camera; farther points only carve free space up to here
  double hit = 0.7;           ///< probability of "occupied" after one hit
  double miss = 0.4;          ///< probability of "occupied" after one ray that passed through
  double clamp_min = 0.1192;  ///< lower bound of the probability, which keeps the map able to change
  double clamp_max = 0.971;   ///< upper bound of the probability, which keeps the map able to change
  double threshold = 0.5;     ///< a voxel with this probability or more is occupied

  /// Throws InputError that names the parameter or field that is out of range.
  void validate() const;
};

/// Visits octree.resolution and octree.max_range; the other fields belong to the sensor model.
void visit(OccupancyOptions& options, ParameterVisitor& visitor);

/// Describes one voxel of the map that was seen at least once.
struct OccupancyVoxel {
  Eigen::Vector3i position;  ///< (0,0,0) spans [0, resolution) on every axis
  float log_odds = 0;
  bool occupied = false;
  Rgb8 color;  ///< mean of the points that hit it; black if the map has no colour
};

/// One bit for each voxel of a block: word z, bit 8 y + x.
using BlockMask = std::array<std::uint64_t, 8>;

/// Holds the voxels that one frame hit and that its rays passed. Small (a few hundred blocks).
struct OccupancyUpdate {
  /// Holds what happened to the voxels of one block.
  struct Masks {
    BlockMask hit{}, passed{};
  };
  /// Sums the colours of the points that hit one voxel.
  struct HitColor {
    std::uint32_t block;  ///< number in `index`
    std::uint32_t local;
    VoxelSum sum;
  };
  BlockIndex index;
  std::vector<Masks> blocks;
  std::vector<HitColor> colors;
};

/// Holds occupied, free and unknown space. Each frame updates each voxel at most once, and a hit takes
/// precedence over a miss, as in octomap::OcTree::insertPointCloud with discretisation; the voxels are the
/// same ones, too.
///
/// With several threads, scan() frames in parallel (const) and apply() the updates from one thread, in the
/// order of the frames (clamping makes the order matter).
class OccupancyGrid {
 public:
  explicit OccupancyGrid(const OccupancyOptions& options = {});

  /// Finds the voxels that a frame hits and passes. `depth` is in metres, 0 if unknown; `color` may be empty,
  /// then the map has no colour.
  [[nodiscard]] OccupancyUpdate scan(const DepthImage& depth, const RgbImage& color, const PixelRays& rays,
                                     const Rigid3& world_from_camera) const;
  /// Applies an update of `scan` to the map.
  void apply(const OccupancyUpdate& update);
  /// Counts one hit for each voxel that holds a point. There are no viewpoints, so nothing becomes free.
  void add_cloud(const Cloud& cloud);

  [[nodiscard]] const OccupancyOptions& options() const { return options_; }
  [[nodiscard]] bool colored() const { return colored_; }
  /// Calls visit for each known voxel, block by block in order of the block keys.
  void visit_sorted(const std::function<void(const OccupancyVoxel&)>& visit) const;

  /// Counts the known voxels.
  struct Counts {
    std::int64_t occupied = 0, free = 0;
  };
  [[nodiscard]] Counts counts() const;

 private:
  struct Colors {
    std::array<VoxelSum, kVoxelsPerBlock> sums;
  };
  struct Block {
    BlockMask known{};
    std::array<float, kVoxelsPerBlock> log_odds{};
    std::unique_ptr<Colors> colors;  // only where something was hit in colour
  };

  [[nodiscard]] Block& block(BlockKey key);
  void add_to_mask(Block& block, const BlockMask& mask, float log_odds) const;

  OccupancyOptions options_;
  float hit_, miss_, clamp_min_, clamp_max_, threshold_;  // log odds
  bool colored_ = false;
  BlockIndex index_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace cairn
