// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/observe/guided_search.h"

namespace cairn {

/// Says that feature `feature` of a frame shows the point, which is `landmark` or, in tracking, a point
/// measured by depth.
struct Correspondence {
  std::int32_t feature = -1;
  LandmarkId landmark;  ///< not valid if the point is no landmark
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// Returns the appearance of a landmark, which is not erased, in the keyframe that is nearest to
/// `centre_in_world`.
[[nodiscard]] Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                                            const Eigen::Vector3d& centre_in_world);

/// Searches the frame for those of `landmarks` (none erased) that it should show, by descriptor, in windows
/// of `radius_px` at the finest scale (GuidedSearch). Leaves out a match at a feature that shows a landmark
/// already (`occupied`, one per feature; empty: none), since the two are duplicates. Returns the
/// correspondences in the order of `landmarks`.
[[nodiscard]] std::vector<Correspondence> find_landmarks(const Map& map,
                                                         std::span<const LandmarkId> landmarks,
                                                         const PosedFrame& frame, double radius_px,
                                                         std::span<const LandmarkId> occupied = {});

}  // namespace cairn
