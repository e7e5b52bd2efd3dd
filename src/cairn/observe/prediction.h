// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "cairn/map/observed_frame.h"
#include "cairn/matching/guided_matching.h"

namespace cairn {

/// How a point looked in an earlier view.
struct Appearance {
  const Descriptors* descriptors = nullptr;
  std::size_t row = 0;
  Keypoint keypoint;
  Eigen::Vector3d centre_in_world;  ///< of the camera then
};

/// A frame, and where its camera is taken to be.
struct PosedFrame {
  const Rig& rig;
  const ObservedFrame& observed;
  Rigid3 camera_from_world;
};

/// Where a point should be seen: nothing behind the camera, from a direction more than 60 degrees away from
/// that of its appearance, or at more than five times its distance or less than a fifth. `radius_px` is for
/// the lowest pyramid level and grows with the expected one.
[[nodiscard]] std::optional<SearchWindow> predict_window(const PosedFrame& view,
                                                         const Eigen::Vector3d& point_in_world,
                                                         const Appearance& appearance, double radius_px);

/// The descriptors, in this order; all of one kind.
[[nodiscard]] Descriptors gather(std::span<const Appearance> appearances);

}  // namespace cairn
