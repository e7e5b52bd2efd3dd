// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "cairn/frontend/prediction.h"
#include "cairn/map/map.h"

namespace cairn {

/// Points to look for in a view, each with the place where it should be seen.
struct SearchTargets {
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<LandmarkId> landmarks;  ///< not valid for a point that is no landmark
  std::vector<PredictedPlace> places;
  std::vector<Appearance> appearances;

  [[nodiscard]] std::size_t size() const { return places.size(); }
};

/// A feature of a view shows a point.
struct FoundPoint {
  std::int32_t feature = -1;
  LandmarkId landmark;  ///< not valid for a point that is no landmark
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
};

/// The look of a landmark in the keyframe that is nearest to `centre_in_world`.
[[nodiscard]] Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                                            const Eigen::Vector3d& centre_in_world);

/// Those of the landmarks (none erased) that the view should show, with the windows they should lie in.
[[nodiscard]] SearchTargets landmark_targets(const Map& map, std::span<const LandmarkId> landmarks,
                                             const FrameView& view, double radius_px);

/// Matches targets with features by descriptor, within the windows. A target whose feature shows a landmark
/// already (`occupied`, one per feature; empty: none) is another of the same thing, and is not found. Ordered
/// by target.
[[nodiscard]] std::vector<FoundPoint> find_targets(const SearchTargets& targets, const FrameView& view,
                                                   std::span<const LandmarkId> occupied,
                                                   const MatchOptions& options);

}  // namespace cairn
