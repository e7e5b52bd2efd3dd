// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/id.h"
#include "cairn/features/features.h"
#include "cairn/geometry/disparity_noise.h"
#include "cairn/geometry/rig.h"
#include "cairn/geometry/stereo_correction.h"

namespace cairn {

/// Holds a frame reduced to what is tracked: feature i of the image, its observation in the undistorted
/// image, and its point if the depth is known.
struct ObservedFrame {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  Features features;
  std::vector<Observation> observations;          ///< one per feature
  std::vector<Eigen::Vector3d> points_in_camera;  ///< one per feature, metres; NaN if the depth is unknown
};

/// Computes the point that an observation shows, in the camera frame, metres; NaN without a disparity.
[[nodiscard]] Eigen::Vector3d point_in_camera(const Rig& rig, const Observation& seen);

/// Takes a field off a disparity. One that is then not above `min_sigmas` of its standard deviations is taken
/// for not measured.
void correct_disparity(const Rig& rig, const DisparityField& field, double min_sigmas, Observation& seen);

/// Takes a field off the disparities (correct_disparity) and computes their points again.
void correct_disparities(const Rig& rig, const DisparityField& field, double min_sigmas,
                         ObservedFrame& frame);

/// Sets the standard deviations of the disparities to those of `noise`.
void weigh_disparities(const Rig& rig, const DisparityNoise& noise, ObservedFrame& frame);

/// Computes the median of the features' depths, metres; NaN if none has a depth.
[[nodiscard]] double median_depth(const ObservedFrame& frame);

}  // namespace cairn
