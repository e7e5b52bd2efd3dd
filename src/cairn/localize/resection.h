// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// A landmark and where the image shows it.
struct Sight {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the point, square metres; finite
  Observation seen;
};

/// Error and derivative of one sight in units of its own uncertainty, see whiten.
struct WhitenedSight {
  Eigen::Vector3d error = Eigen::Vector3d::Zero();  ///< third 0 without a disparity
  Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();
};

/// With e = (u, v, d) projected minus seen, J its derivative by the left perturbation and K that by the
/// point in the world, the error's covariance is S = R + K C K^T: noise of the pixels plus that of the
/// landmark (Bar-Shalom, Li and Kirubarajan 2001, sec. 5.2.3, innovation covariance). Returns L^-1 e and L^-1
/// J with L L^T = S. The point is in front of the camera.
[[nodiscard]] WhitenedSight whiten(const Rig& rig, const CameraFromWorld& camera_from_world,
                                   const Sight& sight);

/// The squared length of the whitened error; infinite for a point that is not in front of the camera.
[[nodiscard]] double squared_innovation(const Rig& rig, const CameraFromWorld& camera_from_world,
                                        const Sight& sight);

struct Resection {
  bool solved = false;  ///< false: fewer than 4 inliers were left, or they do not determine the pose
  CameraFromWorld camera_from_world;
  std::vector<std::int32_t> inliers;  ///< positions of sights within squared_error_limit, increasing
  /// Of the left perturbation (rotation, translation), from the inliers, at unit variance.
  Matrix6d covariance = Matrix6d::Zero();
  /// Squared errors of the inliers over what is expected of them: 1 where the uncertainties are right. The
  /// expectation is that of errors which the limit cuts off.
  double variance_factor = 0;
  double rms_px = 0;  ///< of (u, v) over the inliers
};

/// The pose that explains the sights best: minimises sum_i rho(e_i^T S_i^-1 e_i), rho Huber's kernel, by
/// Gauss-Newton steps with S_i taken anew in each; sights beyond squared_error_limit are left out of the next
/// round and may come back.
[[nodiscard]] Resection resect(const Rig& rig, std::span<const Sight> sights,
                               const CameraFromWorld& initial_camera_from_world);

}  // namespace cairn
