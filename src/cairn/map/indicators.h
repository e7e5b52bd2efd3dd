// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// Of some values: `std` is the standard deviation over their number.
struct ValueRange {
  double mean = 0, min = 0, max = 0, std = 0;
};

/// One view of a landmark.
struct PosedObservation {
  CameraFromWorld camera_from_world;
  Observation seen;
};

/// How good a landmark is, told by the views of it.
struct LandmarkIndicators {
  int frames = 0;        ///< that show it
  double rms_px = 0;     ///< of the distances of pixel and projection; infinite where it is behind a camera
  ValueRange distance;   ///< from the camera, metres
  ValueRange lateral;    ///< from the optical axis, metres
  ValueRange depth;      ///< along it, metres
  ValueRange angle_deg;  ///< between axis and ray
  double max_ray_angle_deg = 0;  ///< the largest between the rays of two views, seen from the landmark
};

/// There is one view at least.
[[nodiscard]] LandmarkIndicators indicators_of(const Rig& rig, const Eigen::Vector3d& point_in_world,
                                               std::span<const PosedObservation> views);

/// The standard deviation of a point along the direction in which it is least certain, metres: the root of
/// the largest eigenvalue of its covariance. Infinite where that is not finite.
[[nodiscard]] double largest_std(const Eigen::Matrix3d& covariance);

}  // namespace cairn
