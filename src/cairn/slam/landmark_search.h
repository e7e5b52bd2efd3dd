// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/observe/guided_search.h"

namespace cairn {

/// A feature of a frame shows a point.
struct Correspondence {
  std::int32_t feature = -1;
  LandmarkId landmark;  ///< not valid for a point that is no landmark
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// The look of a landmark in the keyframe that is nearest to `centre_in_world`.
[[nodiscard]] Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                                            const Eigen::Vector3d& centre_in_world);

/// Looks in the frame for those of the landmarks (none erased) that it should show, by descriptor, in windows
/// of `radius_px` (GuidedSearch). A landmark whose feature shows one already (`occupied`, one per feature;
/// empty: none) is another of the same thing, and is not found. Ordered as `landmarks`.
[[nodiscard]] std::vector<Correspondence> find_landmarks(const Map& map,
                                                         std::span<const LandmarkId> landmarks,
                                                         const PosedFrame& frame, double radius_px,
                                                         std::span<const LandmarkId> occupied = {});

}  // namespace cairn
