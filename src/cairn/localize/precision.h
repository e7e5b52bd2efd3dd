// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/geometry/camera_pose.h"
#include "cairn/localize/common_error.h"

namespace cairn {

/// Holds how precisely a pose is determined. Axes are the camera's: x right, y down, z forward; a vector of
/// six has the rotation about them first (radians), then the position along them (metres).
///
/// With T' = perturb_left((w, v), T) the camera's centre moves by -R^T v in the world, to first order and
/// whatever w: so the covariance of v is that of the position, in the camera's axes.
struct Precision {
  /// Covariance of the left perturbation, within the map: of the poses that the map's own are. By noise, plus
  /// what all landmarks of the place have in common, if the map knows (CommonErrors).
  Matrix6d covariance = Matrix6d::Zero();
  /// Covariance in the world that the poses which made the map are given in; nullopt if the map does not
  /// know.
  std::optional<Matrix6d> absolute;
  /// Dilution of precision: the standard deviations if every observation were wrong by a pixel (1 px in u, v
  /// and d) and the landmarks exact; radians and metres per pixel. gdop is the root of the sum of squares of
  /// the three of the position.
  Vector6d dilution = Vector6d::Zero();
  double gdop = 0;
  /// Protection levels: the error along an axis exceeds its level with a probability of 1e-3, even if one of
  /// the inliers is wrong by as much as goes unnoticed. A level is 3.29 sigma plus the largest slope (error
  /// of the axis by error of an observation, as in receiver autonomous integrity monitoring, Brown and Chin
  /// 1998) times the largest error that its inlier test misses. Within the map, as `covariance`.
  Vector6d protection = Vector6d::Zero();
};

/// Says which factor of the noise counts beside the stated standard deviations. at_least_stated: max(1,
/// variance_factor). as_residuals: variance_factor, for which the errors that observations have in common,
/// and residuals do not show, must be known otherwise (CommonErrors).
enum class NoiseScale { at_least_stated, as_residuals };

/// Computes the precision of `pose`, which must be found from these correspondences, each with a covariance
/// of its point. Scales the covariance by noise by the factor that `scale` names; but for errors that go
/// unnoticed, which the inlier test judges by the stated standard deviations, never by less than 1.
[[nodiscard]] Precision assess_precision(const Rig& rig, const Correspondences& correspondences,
                                         const PoseEstimate& pose,
                                         NoiseScale scale = NoiseScale::at_least_stated);

/// Adds errors that landmarks have in common, in the axes of a keyframe, to a precision by noise alone; the
/// camera is turned by `camera_from_keyframe`.
void add_common_error(const CommonError& error, const Eigen::Quaterniond& camera_from_keyframe,
                      Precision& precision);

}  // namespace cairn
