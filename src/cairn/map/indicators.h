// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// Holds mean, extremes and standard deviation (with the number of values as divisor) of some values.
struct ValueRange {
  double mean = 0, min = 0, max = 0, std = 0;
};

/// Holds one observation of a landmark, and the pose of its camera.
struct PosedObservation {
  CameraFromWorld camera_from_world;
  Observation seen;
};

/// Holds the figures that say how good a landmark is.
struct LandmarkIndicators {
  int frames = 0;                ///< frames that show it
  double rms_px = 0;             ///< RMS distance of pixel and projection; infinite if it is behind a camera
  ValueRange distance;           ///< distance from the camera, metres
  ValueRange lateral;            ///< distance from the optical axis, metres
  ValueRange depth;              ///< depth along the optical axis, metres
  ValueRange angle_deg;          ///< between optical axis and ray
  double max_ray_angle_deg = 0;  ///< largest angle between the rays of two views, seen from the landmark
};

/// Computes the indicators of a landmark from its views. Throws PreconditionError if there are none.
[[nodiscard]] LandmarkIndicators indicators_of(const Rig& rig, const Eigen::Vector3d& point_in_world,
                                               std::span<const PosedObservation> views);

/// Computes the standard deviation of a point along the direction in which it is least certain, metres: the
/// root of the largest eigenvalue of its covariance. Infinite if the covariance is not finite.
[[nodiscard]] double largest_std(const Eigen::Matrix3d& covariance);

}  // namespace cairn
