// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/slam/frame_pose.h"

namespace cairn {

/// Verifies by geometry that a frame shows what the keyframe shows: estimate_motion between the two must be a
/// plausible loop (is_plausible_loop). Returns the frame's pose by that motion, with the landmarks that the
/// inliers show, or nullopt if it is not verified.
[[nodiscard]] std::optional<FramePose> verify_place(const Map& map, KeyframeId keyframe,
                                                    const ObservedFrame& observed,
                                                    const SlamOptions& options);

}  // namespace cairn
