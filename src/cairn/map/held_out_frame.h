// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "cairn/core/id.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Fewest landmarks that agree with a frame that is held out, as TrustOptions::min_inliers has it.
inline constexpr std::size_t kFewestHeldOutInliers = 50;

/// Says by how much a frame of the map was missed when it was located in the landmarks as they are without
/// its observations: what a camera that is localised in the map has to expect. All vectors are of the left
/// perturbation of camera_from_world, in the camera's axes: rotation (radians), then position (metres).
struct HeldOutFrame {
  KeyframeId keyframe;
  Vector6d to_map = Vector6d::Zero();    ///< from the pose found to that of the map
  Vector6d to_given = Vector6d::Zero();  ///< from the pose found to the one that was given for the frame
  Vector6d formal = Vector6d::Zero();  ///< variances of the pose found, by noise alone, as residuals show it
  Vector6d stated = Vector6d::Zero();  ///< variances that the given pose states; 0: none
};

}  // namespace cairn
