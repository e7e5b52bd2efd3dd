// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/features/guided_matching.h"
#include "cairn/map/map.h"

namespace cairn {

/// How a point looked in an earlier view.
struct Appearance {
  const Descriptors* descriptors = nullptr;
  std::size_t row = 0;
  Keypoint keypoint;
  Eigen::Vector3d centre_in_world;  ///< of the camera then
};

/// A view to search in: a frame's features and where its camera is thought to be.
struct FrameView {
  const Rig& rig;
  const ObservedFrame& observed;
  Rigid3 camera_from_world;
};

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

/// How far a descriptor may change between two views of one thing: of random pairs under one in a thousand
/// are nearer.
[[nodiscard]] double descriptor_limit(const Descriptors& descriptors);

/// Where a point should be seen: nothing behind the camera, from a direction
/// more than 60 degrees away from that of its appearance, or at more than five times its distance or less
/// than a fifth. `radius_px` is for the lowest pyramid level and grows with the expected one.
[[nodiscard]] std::optional<PredictedPlace> predict_place(const FrameView& view,
                                                          const Eigen::Vector3d& point_in_world,
                                                          const Appearance& appearance, double radius_px);

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
