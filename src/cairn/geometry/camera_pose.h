// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/rig.h"
#include "cairn/geometry/robust_kernel.h"

namespace cairn {

/// Refers to points in the world and their observations in one camera: element i of each list belongs to the
/// same point.
struct Correspondences {
  std::span<const Eigen::Vector3d> points_in_world;  ///< metres; finite
  /// In the undistorted image of the rig; is_usable holds for each.
  std::span<const Observation> observations;
  /// Of the points, world axes, square metres; empty if points are exact.
  std::span<const Eigen::Matrix3d> covariances = {};

  [[nodiscard]] std::size_t size() const { return observations.size(); }
};

/// Selects the correspondences that determine the pose.
enum class PoseSelection {
  all,  ///< every one
  /// Those that agree with the pose at the start, sorted anew after each round; one whose pixel alone agrees
  /// counts without its disparity.
  inliers,
  /// The first round takes every one in front of the camera, later rounds the inliers: for a rough start.
  inliers_from_all,
};

/// Names the method by which the cost is minimised.
enum class PoseMethod { gauss_newton, levenberg_marquardt };

/// Sets how estimate_pose selects, weights and iterates.
struct PoseOptions {
  PoseSelection selection = PoseSelection::inliers;
  PoseMethod method = PoseMethod::levenberg_marquardt;
  RobustKernel kernel = RobustKernel::huber;
  double kernel_scale = kInlierScale2;  ///< standard deviations, above 0
  /// Whether an observation whose pixel alone agrees is an inlier without its disparity; else it is an
  /// outlier, as is better where many matches are wrong, which a wrong disparity shows.
  bool keep_pixels = true;
  int rounds = 4;           ///< maximum number of rounds of selecting inliers and minimising; at least 1
  int max_iterations = 50;  ///< maximum number of iterations of a round; at least 1, and 4 to 10 are usual
  /// Length of a step that ends a round, radians and metres, above 0: far below what pixels determine.
  double converged_step = 1e-6;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Describes one row of the trace: the start of a round, or a step that was tried.
struct PoseIteration {
  double cost = 0;    ///< half the sum of rho after the step
  double step = 0;    ///< length of the perturbation, 0 for the start of a round
  double lambda = 0;  ///< damping of the step; 0 for the start of a round and for Gauss-Newton
  bool accepted = true;
};

/// Says if a pose was estimated and, if not, why.
enum class PoseStatus {
  ok,
  too_few_points,  ///< fewer than four
  undetermined,    ///< the points do not determine the pose, for example if they lie on a line
  behind_camera,   ///< a point lies behind the camera at the start or after a Gauss-Newton step
  rising_cost,     ///< a step of Gauss-Newton raised the cost
  not_converged,   ///< not converged within max_iterations
};

[[nodiscard]] std::string_view to_string(PoseStatus status);

/// Holds the result of estimate_pose.
struct PoseEstimate {
  PoseStatus status = PoseStatus::too_few_points;
  CameraFromWorld camera_from_world;  ///< the best so far if status is not ok
  /// Positions of the correspondences that agree with the pose in full or in their pixel (Agreement),
  /// increasing, after the last round that could be solved.
  std::vector<std::int32_t> inliers;
  /// Positions of the inliers that agree in their pixel only, increasing. Their disparities do not influence
  /// the result, unless the selection is `all`.
  std::vector<std::int32_t> wrong_disparities;
  /// Covariance of the left perturbation (rotation, translation) for the given standard deviations. Accounts
  /// for the precision lost by the kernel and the limit (KernelMoments). Zero unless status is ok.
  Matrix6d covariance = Matrix6d::Zero();
  /// Sum of the weighted squared errors over its expectation: 1 on average if the standard deviations are
  /// right, whatever the selection and the kernel (with selection `inliers` 0.92 to 0.94 for 30 points, 0.97
  /// to 1 from 100 on). The covariance times this factor is the one that the residuals suggest.
  double variance_factor = 0;
  double rms_px = 0;  ///< root mean square distance of (u, v) over the selected correspondences
  double cost = 0;    ///< half the sum of rho over the selected correspondences
  std::vector<PoseIteration> trace;  ///< the start of each round, then each step tried

  [[nodiscard]] bool found() const { return status == PoseStatus::ok; }
  /// Counts the steps tried in all rounds.
  [[nodiscard]] int iterations() const;
};

/// Estimates the pose of one camera from fixed points: minimises
///
///     1/2 sum_i rho(e_i^T S_i^-1 e_i),  e_i = pi(T X_i) - z_i,  S_i = R_i + K_i C_i K_i^T
///
/// over T = camera_from_world, with z_i = (u, v, d) the observation, R_i its noise, C_i the covariance of the
/// point and K_i the derivative of pi(T X_i) by it (innovation covariance: Bar-Shalom, Li and Kirubarajan
/// 2001, sec. 5.2.3). Each step solves (J^T W J + lambda diag(J^T W J)) xi = -J^T W e, W from S_i and the
/// weight of the kernel at the current pose, and moves T to perturb_left(xi, T); lambda is 0 for Gauss-Newton
/// and follows Marquardt 1963 otherwise. Deterministic, one thread. Throws PreconditionError if lists differ
/// in length, an option is out of range, or a point or pixel is not finite.
[[nodiscard]] PoseEstimate estimate_pose(const Rig& rig, const Correspondences& correspondences,
                                         const CameraFromWorld& initial_camera_from_world,
                                         const PoseOptions& options = {});

}  // namespace cairn
