// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/place_verification.h"

namespace cairn {

std::optional<FramePose> verify_place(const Map& map, KeyframeId keyframe, const ObservedFrame& observed,
                                      const SlamOptions& options) {
  const Keyframe& reference = map[keyframe];
  const auto points = points_of(map, keyframe);
  const Motion motion = estimate_motion(map.rig(), {reference.observed, points}, observed, options);
  if (!is_plausible_loop(motion, options)) return std::nullopt;
  FramePose placed;
  placed.world_from_camera = reference.world_from_camera * motion.current_from_reference.inverse();
  placed.landmarks.resize(observed.observations.size());
  for (const Match& pair : motion.pairs)
    placed.landmarks[static_cast<std::size_t>(pair.query)] =
        reference.landmarks[static_cast<std::size_t>(pair.train)];
  placed.matches = motion.matches;
  placed.inliers = motion.inliers;
  return placed;
}

}  // namespace cairn
