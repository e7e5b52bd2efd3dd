// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Computes the number of frame periods between two stamps, at least 1: how many times max_motion the camera
/// may have moved meanwhile. Returns 1 if the period is not known (0).
[[nodiscard]] double steps_between(std::int64_t from_ns, std::int64_t to_ns, const SlamOptions& options);

/// Returns whether a camera may have moved by `motion` between two stamps: |rotation| + |translation| is
/// below max_motion for each frame period between them, so that missing and refused frames count as well.
[[nodiscard]] bool is_plausible_motion(const Rigid3& motion, std::int64_t from_ns, std::int64_t to_ns,
                                       const SlamOptions& options);

/// Holds the last known pose of the camera in each component of the map, against which a new pose is judged.
class KnownPoses {
 public:
  /// Stores the pose of a frame relative to a keyframe, with which it moves and changes the component.
  void remember(const Map& map, KeyframeId reference, const Rigid3& reference_from_frame,
                std::int64_t stamp_ns);
  /// Returns whether the camera may have come to `world_from_camera` at `stamp_ns` from its last known pose
  /// in the component of `reference`. Returns true if none is known there, as in the map of an earlier run.
  [[nodiscard]] bool allow(const Map& map, KeyframeId reference, const Rigid3& world_from_camera,
                           std::int64_t stamp_ns, const SlamOptions& options) const;

 private:
  struct Known {
    KeyframeId reference;
    Rigid3 reference_from_frame;
    std::int64_t stamp_ns = 0;
  };
  std::vector<Known> poses_;  // the latest last
};

/// Returns whether the camera can have moved between two components as `a_from_b` joins them: each keyframe
/// of this recording is a plausible motion away from the last earlier one in the other component.
[[nodiscard]] bool can_be_joined(const Map& map, std::int32_t component_a, std::int32_t component_b,
                                 const Rigid3& a_from_b, const SlamOptions& options);

}  // namespace cairn
