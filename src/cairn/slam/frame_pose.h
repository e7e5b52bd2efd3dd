// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/slam/landmark_search.h"
#include "cairn/slam/motion.h"

namespace cairn {

/// Where a frame was taken, and the landmarks that its features show.
struct FramePose {
  Rigid3 world_from_camera;
  std::vector<LandmarkId> landmarks;  ///< one per feature; not valid where it shows none
  int matches = 0;                    ///< features that were matched with points
  int inliers = 0;                    ///< those that agree with the pose
};

/// The pose that most of the found points agree with, from a start that is right to some tens of pixels;
/// `landmarks` are those of the inliers. False, and `tracked` as it was, where fewer than `min_inliers`
/// agree.
[[nodiscard]] bool solve_pose(const PosedFrame& view, std::span<const Correspondence> found, int min_inliers,
                              FramePose& tracked);

/// Looks for what the map around the frame holds besides the landmarks it has already, and solves for the
/// pose again with all of them. False, and `tracked` as it was, where fewer than min_inliers agree, or fewer
/// than half of those before.
[[nodiscard]] bool refine_in_map(const Map& map, const ObservedFrame& observed, const SlamOptions& options,
                                 FramePose& tracked);

}  // namespace cairn
