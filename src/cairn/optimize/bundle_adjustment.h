// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/rig.h"
#include "cairn/geometry/robust_kernel.h"
#include "cairn/geometry/stereo_correction.h"

namespace cairn {

/// Describes the observation of a point by a camera.
struct BundleObservation {
  std::int32_t camera = 0;  ///< position in camera_from_world
  std::int32_t point = 0;   ///< position in points_in_world
  Observation seen;
};

/// States what is known of a camera's pose beside its observations: a Gaussian about `camera_from_world`.
struct CameraPrior {
  std::int32_t camera = 0;   ///< position in BundleProblem::camera_from_world
  Rigid3 camera_from_world;  ///< mean
  /// Inverse covariance of left_perturbation(mean, pose): rotation (radians), then translation (metres), in
  /// the camera's axes. Symmetric and not negative.
  Matrix6d information = Matrix6d::Zero();
};

/// Holds cameras, points and the observations that connect them.
struct BundleProblem {
  Rig rig;
  std::vector<Rigid3> camera_from_world;
  std::vector<char> camera_fixed;  ///< one for each camera, 1 if its pose is kept
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<BundleObservation> observations;  ///< in any order; a camera sees a point at most once
  std::vector<CameraPrior> priors = {};         ///< in any order; one for a camera at most
};

/// Sets the kernel and the convergence of adjust_bundle.
struct BundleOptions {
  RobustKernel kernel = RobustKernel::huber;
  double kernel_scale = kInlierScale2;  ///< standard deviations
  int max_iterations = 10;  ///< maximum number of steps tried; a window near its minimum takes 3 to 5
  /// Relative decrease of the cost below which a step has converged: 1e-4 moves the result by far less than
  /// its own standard deviation.
  double converged_relative_cost = 1e-4;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Says if a bundle was adjusted and, if not, why.
enum class BundleStatus {
  ok,             ///< converged
  not_converged,  ///< not converged within max_iterations; the best so far is kept
  undetermined,   ///< the equations could not be solved at any damping tried; nothing moved
  nothing_free,   ///< there are no observations, so that there is nothing to adjust
};

[[nodiscard]] std::string_view to_string(BundleStatus status);

/// Describes the result of adjust_bundle.
struct BundleReport {
  BundleStatus status = BundleStatus::nothing_free;
  double cost_before = 0;  ///< half the sum of rho(squared_error) at the start
  double cost_after = 0;   ///< half the sum of rho(squared_error) at the result
  int iterations = 0;      ///< steps tried
  /// One for each observation, 1 if squared_error is below squared_error_limit at the result.
  std::vector<char> inlier;
};

/// Moves the free cameras T_i = camera_from_world and all points X_j to the minimum of
///
///     1/2 sum_ij rho(|S_ij (pi(T_i X_j) - z_ij)|^2) + 1/2 sum_k e_k^T P_k e_k
///
/// over the observations z = (u, v, d), S their inverse standard deviations, and the priors of free cameras,
/// P their information, e = left_perturbation(mean, T): Levenberg-Marquardt over the equations of the cameras
/// alone, from which the points are eliminated (Schur complement; Brown 1958; Triggs, McLauchlan, Hartley,
/// Fitzgibbon 2000, sec. 6.1). Cameras are perturbed by perturb_left.
///
/// Some observations do not influence the result and keep their last cost (zero from the start) for the rest
/// of the call: those behind their camera at the start or after a step, and those of a point that its
/// observations do not determine, for example one pixel without disparity; such a point is not moved. Without
/// a fixed camera, the position of the result (and its scale, if no observation has a disparity) follows from
/// the start and the damping.
///
/// Throws PreconditionError if a position is out of range, an observation is unusable, a value is not finite,
/// focal lengths or baseline are not above 0, a camera sees a point twice or has two priors. Gives the same
/// bits at any number of threads.
[[nodiscard]] BundleReport adjust_bundle(BundleProblem& problem, const BundleOptions& options,
                                         const Executor& executor = Executor());

/// Sets the prior of adjust_bundle_with_field.
struct FieldOptions {
  /// Standard deviation of each coefficient about zero, pixels: after a rectification disparities are
  /// seldom wrong by more than twice this.
  double prior_sigma_px = 0.5;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Describes the result of adjust_bundle_with_field.
struct FieldReport {
  BundleReport bundle;  ///< both costs include the prior's; inliers are judged with the field taken off
  DisparityField field = DisparityField::Zero();  ///< pixels
  /// Formal covariance of the field, square pixels: cameras and points estimated with it, weights of the
  /// kernel at the result, prior included.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::size_t disparities = 0;  ///< that influenced the result
};

/// Moves cameras and points as adjust_bundle does, and with them the one field c of all disparities of the
/// problem, to the minimum of
///
///     1/2 sum_ij rho(|S_ij (pi(T_i X_j) + (0, 0, a_ij c) - z_ij)|^2) + 1/2 |c|^2 / prior_sigma_px^2
///
/// with a = disparity_field_basis of the measured column. `field` is the start, usually zero, and the result.
/// If there are no observations or the equations could not be solved, it stays, and the covariance is that of
/// the prior. Without a fixed camera the covariance is the same as with one.
///
/// Throws PreconditionError as adjust_bundle does, and if `field` is not finite. Gives the same bits at any
/// number of threads.
[[nodiscard]] FieldReport adjust_bundle_with_field(BundleProblem& problem, DisparityField& field,
                                                   const BundleOptions& options,
                                                   const FieldOptions& field_options = {},
                                                   const Executor& executor = Executor());

/// Computes the covariance of each point in the world, square metres, from the standard deviations of its
/// observations with `use_observation` (one for each observation, 1 to use it) in front of their camera.
/// Cameras are taken as exact; no kernel. If they do not determine a point, its matrix has infinity on the
/// diagonal and zeros elsewhere. Throws PreconditionError if the problem is invalid or `use_observation` has
/// another length.
[[nodiscard]] std::vector<Eigen::Matrix3d> point_covariances(const BundleProblem& problem,
                                                             std::span<const char> use_observation,
                                                             const Executor& executor = Executor());

}  // namespace cairn
