// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cairn/map/observed_frame.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/observe/prediction.h"

namespace cairn {

/// Says that feature `feature` of the image shows a landmark of the map.
struct LandmarkMatch {
  std::int32_t feature = -1;
  Observation seen;  ///< observation of the feature
  LandmarkId landmark;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  /// Covariance of the point that is its own (StoredMap::noise_covariance), square metres; finite.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double distance = 0;  ///< of the point from the camera of the keyframe that was matched, metres
};

using Keyframes = std::vector<std::shared_ptr<const StoredKeyframe>>;

/// Matches the image with the landmarks that each keyframe shows: nearest by descriptor, mutual, and clearly
/// nearer than the second (`max_ratio`). Keeps the nearest match of each feature and of each landmark, and
/// leaves out landmarks whose covariance is not finite. Returns the matches by feature.
[[nodiscard]] std::vector<LandmarkMatch> match_keyframes(const StoredMap& map, const Keyframes& keyframes,
                                                         const ObservedFrame& observed, double max_ratio);

/// Matches features with the landmarks that the keyframes show, within `radius_px` at the finest scale of
/// where the pose predicts them. Keeps the nearest match of each feature and of each landmark, and leaves out
/// landmarks whose covariance is not finite. Returns the matches by feature.
[[nodiscard]] std::vector<LandmarkMatch> match_predicted_landmarks(const StoredMap& map,
                                                                   const Keyframes& keyframes,
                                                                   const PosedFrame& frame, double radius_px);

}  // namespace cairn
