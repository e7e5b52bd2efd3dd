// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"

namespace cairn {

struct PoseOnlyOptions {
  int rounds = 4;                ///< after each, observations are sorted anew into inliers and outliers
  int iterations_per_round = 8;  ///< Gauss-Newton steps, fewer on convergence
  double converged_step = 1e-8;  ///< radians and metres
  /// All observations are used in the first round: for a start whose errors are larger than the limit and
  /// observations that are mostly right. Else those that are inliers at the start.
  bool begin_with_all = false;
  double huber_px = 2.4;  ///< kernel width in standard deviations: the root of the 95 % limit of (u, v)
};

struct PoseOnlyResult {
  bool solved = false;  ///< false: fewer than 4 inliers were left, or the pose is not determined by them
  CameraFromWorld camera_from_world;
  /// Inverse covariance of the left perturbation (rotation, translation), see perturb_left; from the inliers,
  /// at unit variance.
  Matrix6d information = Matrix6d::Zero();
  std::vector<std::int32_t> inliers;  ///< positions of observations within squared_error_limit, increasing
  double variance_factor =
      0;  ///< a posteriori: sum of squared errors over degrees of freedom; 1 if the sigmas are right
  double rms_px = 0;  ///< of (u, v) over the inliers
};

/// Refines one camera pose, points fixed: minimises sum_i rho(|S_i (pi(T X_i) - z_i)|^2) over T, where z =
/// (u, v, d), S holds the inverse standard deviations and rho is Huber's kernel (iteratively reweighted
/// Gauss-Newton). Observations outside squared_error_limit after a round are left out of the next one, and
/// may come back.
[[nodiscard]] PoseOnlyResult refine_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const Observation> seen,
                                         const CameraFromWorld& initial_camera_from_world,
                                         const PoseOnlyOptions& options = {});

}  // namespace cairn
