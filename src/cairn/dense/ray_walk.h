// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/dense/occupancy.h"

namespace cairn {

/// Marks the voxels that rays pass in an OccupancyUpdate. All rays start in one point.
class RayWalk {
 public:
  /// `origin_in_world` and `resolution` in metres.
  RayWalk(const Eigen::Vector3f& origin_in_world, double resolution, OccupancyUpdate& update);

  /// Marks the voxels between the origin and `end_in_world` as passed, from the origin's voxel to the one
  /// before the end's (Amanatides and Woo 1987), with the arithmetic of octomap's computeRayKeys, so that the
  /// same voxels are met.
  void pass_to(const Eigen::Vector3f& end_in_world);
  /// Marks one voxel as hit; returns the number of its block.
  std::uint32_t hit(const VoxelKey& voxel);

  /// Returns the voxel in which a point lies.
  [[nodiscard]] VoxelKey voxel_at(const Eigen::Vector3f& point_in_world) const;
  /// Returns the centre of a voxel, metres.
  [[nodiscard]] Eigen::Vector3f centre_of(const VoxelKey& voxel) const;

 private:
  struct Step;
  [[nodiscard]] Step first_step(const Eigen::Vector3f& direction) const;
  [[nodiscard]] std::uint32_t block(BlockKey key);
  [[nodiscard]] double centre(std::uint32_t key) const;

  Eigen::Vector3f origin_;
  double resolution_;
  VoxelKey origin_voxel_;
  OccupancyUpdate& update_;
};

}  // namespace cairn
