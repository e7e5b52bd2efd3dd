// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Frame periods between two stamps, at least 1: how many times max_motion the camera may have moved
/// meanwhile. Where the period is not known (0), 1.
[[nodiscard]] double steps_between(std::int64_t from_ns, std::int64_t to_ns, const SlamOptions& options);

/// Whether a camera may have moved so far between two stamps: |rotation| + |translation| below max_motion for
/// each frame period between them, so that frames which are missing or were refused count as well.
[[nodiscard]] bool is_plausible_motion(const Rigid3& motion, std::int64_t from_ns, std::int64_t to_ns,
                                       const SlamOptions& options);

/// The last pose of the camera that is known in each component of the map, against which a new one is judged.
class KnownPoses {
 public:
  /// A frame's pose relative to a keyframe; it moves with that and goes with its component.
  void remember(const Map& map, KeyframeId reference, const Rigid3& reference_from_frame,
                std::int64_t stamp_ns);
  /// Whether the camera may be there at that time, in the component of `reference`; true where none of its
  /// poses is known, as in the map of an earlier run.
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

/// Whether the keyframes of this recording in two components, put together by `a_from_b`, make a plausible
/// motion: each from the last one of the other component before it.
[[nodiscard]] bool can_be_joined(const Map& map, std::int32_t component_a, std::int32_t component_b,
                                 const Rigid3& a_from_b, const SlamOptions& options);

}  // namespace cairn
