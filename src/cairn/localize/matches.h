// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cairn/map/observed_frame.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/observe/prediction.h"

namespace cairn {

/// Feature `feature` of the image shows a landmark of the map.
struct LandmarkMatch {
  std::int32_t feature = -1;
  Observation seen;  ///< of the feature
  LandmarkId landmark;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the point, square metres; finite
  double distance = 0;  ///< from the camera of the keyframe whose look was matched, metres
};

using Keyframes = std::vector<std::shared_ptr<const StoredKeyframe>>;

/// Matches the image with what each keyframe shows: nearest by descriptor, mutual, and clearly nearer than
/// the second (`max_ratio`). A landmark counts as it looks in any of them. Each feature and each landmark is
/// in one match, the nearest; ordered by feature. Landmarks that nothing determines are left out.
[[nodiscard]] std::vector<LandmarkMatch> match_keyframes(const StoredMap& map, const Keyframes& keyframes,
                                                         const ObservedFrame& observed, double max_ratio);

/// Matches of the landmarks that the keyframes show with features near the places where the pose has them,
/// as far as `radius_px` at the lowest pyramid level. Otherwise as match_keyframes, without the ratio.
[[nodiscard]] std::vector<LandmarkMatch> match_predicted_landmarks(const StoredMap& map,
                                                                   const Keyframes& keyframes,
                                                                   const PosedFrame& frame, double radius_px);

}  // namespace cairn
