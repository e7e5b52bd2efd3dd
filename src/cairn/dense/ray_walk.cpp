// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/ray_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

void mark(BlockMask& mask, const VoxelKey& voxel) {
  mask[voxel[2] & 7U] |= std::uint64_t{1} << ((voxel[1] & 7U) << kBlockBits | (voxel[0] & 7U));
}

}  // namespace

/// For each axis: the direction of the next voxel, the distance along the ray at which it begins, and the
/// distance between two borders.
struct RayWalk::Step {
  std::array<std::uint32_t, 3> by{};  // 1, or 2^32 - 1 for one back
  std::array<double, 3> next{}, between{};

  [[nodiscard]] std::size_t nearest_axis() const {  // in octomap's order of comparisons
    if (next[0] < next[1]) return next[0] < next[2] ? 0 : 2;
    return next[1] < next[2] ? 1 : 2;
  }
};

RayWalk::RayWalk(const Eigen::Vector3f& origin_in_world, double resolution, OccupancyUpdate& update)
    : origin_(origin_in_world), resolution_(resolution), origin_voxel_{}, update_(update) {
  origin_voxel_ = voxel_at(origin_);
}

VoxelKey RayWalk::voxel_at(const Eigen::Vector3f& point_in_world) const {
  const double scale = 1.0 / resolution_;
  VoxelKey voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<std::int32_t>(std::floor(scale * point_in_world[axis]));
    voxel[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(coordinate + kVoxelOffset);
  }
  return voxel;
}

double RayWalk::centre(std::uint32_t key) const {
  return (static_cast<double>(static_cast<std::int32_t>(key) - kVoxelOffset) + 0.5) * resolution_;
}

Eigen::Vector3f RayWalk::centre_of(const VoxelKey& voxel) const {
  return Eigen::Vector3d(centre(voxel[0]), centre(voxel[1]), centre(voxel[2])).cast<float>();
}

std::uint32_t RayWalk::block(BlockKey key) {
  const std::uint32_t number = update_.index.find_or_insert(key);
  if (number == update_.blocks.size()) update_.blocks.emplace_back();
  return number;
}

std::uint32_t RayWalk::hit(const VoxelKey& voxel) {
  const std::uint32_t number = block(block_of(voxel));
  mark(update_.blocks[number].hit, voxel);
  return number;
}

RayWalk::Step RayWalk::first_step(const Eigen::Vector3f& direction) const {
  Step step;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const float along = direction[axis];
    if (!(along > 0) && !(along < 0)) {
      step.next[i] = step.between[i] = std::numeric_limits<double>::max();
      continue;
    }
    const int sign = along > 0 ? 1 : -1;
    step.by[i] = static_cast<std::uint32_t>(sign);
    const double border =
        centre(origin_voxel_[i]) + static_cast<double>(static_cast<float>(sign * resolution_ * 0.5));
    step.next[i] = (border - static_cast<double>(origin_[axis])) / static_cast<double>(along);
    step.between[i] = resolution_ / std::abs(static_cast<double>(along));
  }
  return step;
}

void RayWalk::pass_to(const Eigen::Vector3f& end_in_world) {
  const VoxelKey end = voxel_at(end_in_world);
  VoxelKey voxel = origin_voxel_;
  if (voxel == end) return;
  const Eigen::Vector3f way = end_in_world - origin_;
  const float squared = way.x() * way.x() + way.y() * way.y() + way.z() * way.z();
  const auto length = static_cast<float>(std::sqrt(static_cast<double>(squared)));
  Step step = first_step(Eigen::Vector3f(way.x() / length, way.y() / length, way.z() / length));
  BlockMask* passed = &update_.blocks[block(block_of(voxel))].passed;
  mark(*passed, voxel);
  while (true) {
    const std::size_t axis = step.nearest_axis();
    const std::uint32_t before = voxel[axis];
    voxel[axis] += step.by[axis];
    step.next[axis] += step.between[axis];
    if (voxel == end) return;
    if (std::min({step.next[0], step.next[1], step.next[2]}) > static_cast<double>(length)) return;
    if (((before ^ voxel[axis]) >> kBlockBits) != 0) passed = &update_.blocks[block(block_of(voxel))].passed;
    mark(*passed, voxel);
  }
}

}  // namespace cairn
