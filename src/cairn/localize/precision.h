// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/camera_pose.h"

namespace cairn {

/// Holds how precisely a pose is determined. Axes are the camera's: x right, y down, z forward; a vector of
/// six has the rotation about them first (radians), then the position along them (metres).
///
/// With T' = perturb_left((w, v), T) the camera's centre moves by -R^T v in the world, to first order and
/// whatever w: so the covariance of v is that of the position, in the camera's axes.
struct Precision {
  Matrix6d covariance = Matrix6d::Zero();  ///< of the left perturbation
  /// Dilution of precision: the standard deviations if every observation were wrong by a pixel (1 px in u, v
  /// and d) and the landmarks exact; radians and metres per pixel. gdop is the root of the sum of squares of
  /// the three of the position.
  Vector6d dilution = Vector6d::Zero();
  double gdop = 0;
  /// Protection levels: the error along an axis exceeds its level with a probability of 1e-3, even if one of
  /// the inliers is wrong by as much as goes unnoticed. A level is 3.29 sigma plus the largest slope (error
  /// of the axis by error of an observation, as in receiver autonomous integrity monitoring, Brown and Chin
  /// 1998) times the largest error that its inlier test misses.
  Vector6d protection = Vector6d::Zero();
};

/// Computes the precision of `pose`, which must be found from these correspondences, each with a covariance
/// of its point. Scales the covariance by max(1, variance_factor).
[[nodiscard]] Precision assess_precision(const Rig& rig, const Correspondences& correspondences,
                                         const PoseEstimate& pose);

}  // namespace cairn
