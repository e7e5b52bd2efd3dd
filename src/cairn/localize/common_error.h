// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/map/held_out_frame.h"

namespace cairn {

/// Holds variances beyond those of noise, in a keyframe's axes: rotation (radians squared), then position
/// (square metres).
struct CommonError {
  Vector6d to_map = Vector6d::Zero();    ///< of a pose against the map's own poses
  Vector6d to_world = Vector6d::Zero();  ///< against the true ones, as far as the given poses are
};

/// Models the error that all landmarks of a place have in common, so that no number of them averages it out:
/// errors of the poses that made it, of the calibration, centres of features that wander with the view. It is
/// measured on held-out frames: the mean square by which they were missed, less the variance by noise, near a
/// keyframe, drawn towards that of the whole map as few say little.
class CommonErrors {
 public:
  explicit CommonErrors(std::span<const HeldOutFrame> frames);

  /// Returns the errors near a keyframe; nullopt if fewer than three frames were held out.
  [[nodiscard]] std::optional<CommonError> near(KeyframeId keyframe) const;

 private:
  std::vector<HeldOutFrame> frames_;
  CommonError mean_;
};

/// Turns variances from the axes of one camera to those of another, which `to_from` turns: a 6x6 covariance.
[[nodiscard]] Matrix6d turned(const Vector6d& variances, const Eigen::Quaterniond& to_from);

}  // namespace cairn
