// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"
#include "cairn/optimize/kernels/landmark_kernels.h"

namespace cairn {

/// Describes a landmark's observation by camera number `camera`.
struct CameraObservation {
  std::int32_t camera = 0;
  Observation seen;
};

/// Holds the pose of a camera as packing needs it.
struct PlacedCamera {
  Eigen::Matrix3d world_from_camera;  ///< rotation: its columns are the camera's axes
  Eigen::Vector3d centre_in_world;

  explicit PlacedCamera(const CameraFromWorld& pose)
      : world_from_camera(pose.inverse().matrix3()), centre_in_world(pose.inverse().translation) {}
};

/// Packs the observations of one landmark for the kernels. Points are relative to the centre of the first
/// observation's camera, so that a world of thousands of kilometres costs no digits. The next landmark reuses
/// the memory.
class PackedObservations {
 public:
  /// Packs `all`. Throws PreconditionError if a camera is out of range or an observation is not usable.
  void pack(const Rig& rig, std::span<const PlacedCamera> cameras, std::span<const CameraObservation> all);

  /// Drops the observation in `slot`; the last one moves to this slot.
  void drop(int slot);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int block_count() const { return (count_ + kObservationLanes - 1) / kObservationLanes; }
  [[nodiscard]] const ObservationBlock* blocks() const { return blocks_.data(); }
  /// Returns the position, among all packed, of the observation in `slot`, which is below count().
  [[nodiscard]] std::int32_t observation(int slot) const {
    return observations_[static_cast<std::size_t>(slot)];
  }
  [[nodiscard]] const Eigen::Vector3d& origin_in_world() const { return origin_in_world_; }

 private:
  void put(const Rig& rig, const PlacedCamera& camera, const Observation& seen, int slot);
  void move(int from, int to);
  /// Gives the slots of the last block that hold no observation the axis and centre of the first one.
  void fill_up();

  int count_ = 0;
  Eigen::Vector3d origin_in_world_ = Eigen::Vector3d::Zero();
  std::vector<ObservationBlock> blocks_;
  std::vector<std::int32_t> observations_;
};

}  // namespace cairn
