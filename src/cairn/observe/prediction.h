// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "cairn/map/observed_frame.h"
#include "cairn/matching/guided_matching.h"

namespace cairn {

/// Describes how a point looked in an earlier view.
struct Appearance {
  const Descriptors* descriptors = nullptr;
  std::size_t row = 0;
  Keypoint keypoint;
  Eigen::Vector3d centre_in_world;  ///< centre of the camera of that view
};

/// Holds an observed frame and the pose that its camera is taken to have.
struct PosedFrame {
  const Rig& rig;
  const ObservedFrame& observed;
  Rigid3 camera_from_world;
};

/// Predicts where a point should be seen. Returns nullopt if it is behind the camera, if it is seen from a
/// direction more than 60 degrees away from that of its appearance, or at more than five times its distance
/// or less than a fifth. `radius_px` is the radius at the finest scale and grows with the expected scale.
[[nodiscard]] std::optional<SearchWindow> predict_window(const PosedFrame& view,
                                                         const Eigen::Vector3d& point_in_world,
                                                         const Appearance& appearance, double radius_px);

/// Returns the descriptors of the appearances, in their order; all must be of one kind.
[[nodiscard]] Descriptors gather(std::span<const Appearance> appearances);

}  // namespace cairn
