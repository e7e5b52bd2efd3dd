// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/packed_observations.h"

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

ObservationBlock& block_of(std::vector<ObservationBlock>& blocks, int slot) {
  return blocks[static_cast<std::size_t>(slot / kObservationLanes)];
}

void store(const Eigen::Vector3d& value, double (*to)[kObservationLanes], int lane) {
  for (int i = 0; i < 3; ++i) to[i][lane] = value[i];
}

void copy(const double (*from)[kObservationLanes], int from_lane, double (*to)[kObservationLanes],
          int to_lane) {
  for (int i = 0; i < 3; ++i) to[i][to_lane] = from[i][from_lane];
}

}  // namespace

void PackedObservations::pack(const Rig& rig, std::span<const PlacedCamera> cameras,
                              std::span<const CameraObservation> all) {
  count_ = static_cast<int>(all.size());
  if (observations_.size() < all.size()) {
    observations_.resize(all.size());
    blocks_.resize(static_cast<std::size_t>(block_count()));
  }
  bool in_range = true, usable = true;
  for (const CameraObservation& observation : all) {
    in_range = in_range && static_cast<std::uint32_t>(observation.camera) < cameras.size();
    usable = usable && is_usable(observation.seen);
  }
  require(in_range, "an observation is by a camera");
  require(usable, "pixels are finite and sigmas above 0");
  if (all.empty()) return;
  origin_in_world_ = cameras[static_cast<std::size_t>(all[0].camera)].centre_in_world;
  for (int slot = 0; slot < count_; ++slot) {
    const CameraObservation& observation = all[static_cast<std::size_t>(slot)];
    put(rig, cameras[static_cast<std::size_t>(observation.camera)], observation.seen, slot);
    observations_[static_cast<std::size_t>(slot)] = slot;
  }
  fill_up();
}

void PackedObservations::put(const Rig& rig, const PlacedCamera& camera, const Observation& seen, int slot) {
  ObservationBlock& block = block_of(blocks_, slot);
  const int lane = slot % kObservationLanes;
  const double per_px = 1.0 / seen.sigma_px, per_d_px = seen.has_disparity() ? 1.0 / seen.sigma_d_px : 0.0;
  const auto right = camera.world_from_camera.col(0), down = camera.world_from_camera.col(1),
             axis = camera.world_from_camera.col(2);
  store(per_px * rig.fx * right - per_px * (seen.u - rig.cx) * axis, block.u, lane);
  store(per_px * rig.fy * down - per_px * (seen.v - rig.cy) * axis, block.v, lane);
  store(axis, block.axis, lane);
  store(camera.centre_in_world - origin_in_world_, block.centre, lane);
  block.disparity_scale[lane] = rig.fx * rig.baseline * per_d_px;
  block.disparity[lane] = seen.has_disparity() ? seen.d * per_d_px : 0.0;
}

void PackedObservations::drop(int slot) {
  require(slot >= 0 && slot < count_, "a slot holds an observation");
  --count_;
  if (slot != count_) move(count_, slot);
  if (count_ > 0) fill_up();
}

void PackedObservations::move(int from, int to) {
  const ObservationBlock& source = block_of(blocks_, from);
  ObservationBlock& target = block_of(blocks_, to);
  const int old_lane = from % kObservationLanes, new_lane = to % kObservationLanes;
  copy(source.u, old_lane, target.u, new_lane);
  copy(source.v, old_lane, target.v, new_lane);
  copy(source.axis, old_lane, target.axis, new_lane);
  copy(source.centre, old_lane, target.centre, new_lane);
  target.disparity_scale[new_lane] = source.disparity_scale[old_lane];
  target.disparity[new_lane] = source.disparity[old_lane];
  observations_[static_cast<std::size_t>(to)] = observations_[static_cast<std::size_t>(from)];
}

void PackedObservations::fill_up() {
  const ObservationBlock& first = blocks_.front();
  for (int slot = count_; slot % kObservationLanes != 0; ++slot) {
    ObservationBlock& block = block_of(blocks_, slot);
    const int lane = slot % kObservationLanes;
    store(Eigen::Vector3d::Zero(), block.u, lane);
    store(Eigen::Vector3d::Zero(), block.v, lane);
    copy(first.axis, 0, block.axis, lane);
    copy(first.centre, 0, block.centre, lane);
    block.disparity_scale[lane] = block.disparity[lane] = 0.0;
  }
}

}  // namespace cairn
