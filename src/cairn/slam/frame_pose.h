// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/slam/landmark_search.h"
#include "cairn/slam/motion.h"

namespace cairn {

/// Holds the pose of a frame and the landmarks that its features show.
struct FramePose {
  Rigid3 world_from_camera;
  std::vector<LandmarkId> landmarks;  ///< one per feature; not valid if it shows none
  int matches = 0;                    ///< features matched with points
  int inliers = 0;                    ///< matches that agree with the pose
  /// Whether the inliers determine the pose (cairn::is_determined); false unless solve_pose set it.
  bool is_determined = false;
};

/// Solves for the pose of `view` from the correspondences `found`, starting from the pose that it has, which
/// may be wrong by some tens of pixels. Sets `tracked` to the result, with the landmarks of the inliers.
/// Returns false and leaves `tracked` unchanged if fewer than `min_inliers` agree.
[[nodiscard]] bool solve_pose(const PosedFrame& view, std::span<const Correspondence> found, int min_inliers,
                              FramePose& tracked);

/// Searches the frame for further landmarks of the map around it, and solves for its pose again with all of
/// them. Returns false and leaves `tracked` unchanged if fewer than min_inliers, or fewer than half of its
/// inliers, agree.
[[nodiscard]] bool refine_in_map(const Map& map, const ObservedFrame& observed, const SlamOptions& options,
                                 FramePose& tracked);

}  // namespace cairn
