// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// Computes the unweighted derivative of the residual by the left perturbation: rows du, dv, dd; columns
/// rotation, translation. With p the point in the camera, exp(w) p + v = p - [p]x w + v to first order, so it
/// is the projection's derivative by the point times (-[p]x, I) (Barfoot 2017, State Estimation for Robotics,
/// sec. 7.1.8 and 7.3).
[[nodiscard]] Eigen::Matrix<double, 3, 6> observation_jacobian(const Rig& rig,
                                                               const Eigen::Vector3d& point_in_camera);

/// Tells whether the pixel and, if present, the disparity are finite and their standard deviations above 0.
[[nodiscard]] bool is_usable(const Observation& seen);

/// Throws PreconditionError unless the points are finite and the observations usable.
void require_observations(std::span<const Eigen::Vector3d> points_in_world,
                          std::span<const Observation> seen);

/// Computes the covariance S = R + K C K^T of the error (u, v, d), projected minus observed: R is the noise
/// of the pixels, C = `point_covariance` the covariance of the point (world axes), K the derivative of the
/// projection by it. Row and column of a disparity that was not measured are those of the identity.
[[nodiscard]] Eigen::Matrix3d innovation_covariance(const Rig& rig, const Eigen::Matrix3d& camera_from_world,
                                                    const Eigen::Vector3d& point_in_camera,
                                                    const Observation& seen,
                                                    const Eigen::Matrix3d& point_covariance);

/// Holds the error of one observation and its derivative, both in units of the error's own uncertainty.
struct WhitenedError {
  Eigen::Vector3d error = Eigen::Vector3d::Zero();  ///< projected minus seen; third 0 without a disparity
  Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();  ///< by the left perturbation
};

/// Divides error and derivative by the standard deviations of the observation. The point must be in front of
/// the camera.
[[nodiscard]] WhitenedError whiten(const Rig& rig, const Eigen::Vector3d& point_in_camera,
                                   const Observation& seen);

/// Multiplies error and derivative by L^-1, with L L^T the innovation_covariance. The point must be in front
/// of the camera.
[[nodiscard]] WhitenedError whiten(const Rig& rig, const CameraFromWorld& camera_from_world,
                                   const Eigen::Vector3d& point_in_world, const Observation& seen,
                                   const Eigen::Matrix3d& point_covariance);

/// Holds the normal equations of one camera's pose: J^T W J and J^T W e, summed over observations.
struct PoseEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();

  /// Adds one observation times `weight`.
  void add(const WhitenedError& whitened, double weight);
  /// Computes the Gauss-Newton step -(hessian)^-1 gradient. Returns nullopt if the observations do not
  /// determine the pose.
  [[nodiscard]] std::optional<Vector6d> solve() const;
};

}  // namespace cairn
