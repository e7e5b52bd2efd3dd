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

namespace cairn {

struct BundleObservation {
  std::int32_t camera = 0;  ///< position in camera_from_world
  std::int32_t point = 0;   ///< position in points_in_world
  Observation seen;
};

/// Cameras and landmarks with what the ones saw of the others.
struct BundleProblem {
  Rig rig;
  std::vector<Rigid3> camera_from_world;
  std::vector<char> camera_fixed;  ///< one for each camera, 1: stays where it is
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<BundleObservation> observations;  ///< in any order; a camera sees a point at most once
};

struct BundleOptions {
  RobustKernel kernel = RobustKernel::huber;
  double kernel_scale = kInlierScale2;  ///< standard deviations
  int max_iterations = 10;              ///< steps tried; a window near its minimum takes 3 to 5
  /// Converged when a step lowers the cost by less than this share: 1e-4 of it moves the result by far less
  /// than its own standard deviation.
  double converged_relative_cost = 1e-4;

  /// PreconditionError for a value out of range.
  void validate() const;
};

enum class BundleStatus {
  ok,             ///< converged
  not_converged,  ///< within max_iterations; the best so far is kept
  undetermined,   ///< the equations could not be solved at any damping tried; nothing moved
  nothing_free,   ///< no observation of a point, so that there is nothing to adjust
};

[[nodiscard]] std::string_view to_string(BundleStatus status);

struct BundleReport {
  BundleStatus status = BundleStatus::nothing_free;
  double cost_before = 0;    ///< half the sum of rho(squared_error) at the start
  double cost_after = 0;     ///< the same at the result
  int iterations = 0;        ///< steps tried
  std::vector<char> inlier;  ///< for each observation: squared_error below squared_error_limit at the result
};

/// Moves the free cameras T_i = camera_from_world and all points X_j to the least
///
///     1/2 sum_ij rho(|S_ij (pi(T_i X_j) - z_ij)|^2)
///
/// over the observations z = (u, v, d), S their inverse standard deviations: Levenberg-Marquardt over the
/// cameras' equations alone, from which the points are eliminated (Schur complement; Brown 1958; Triggs,
/// McLauchlan, Hartley, Fitzgibbon 2000, sec. 6.1). Cameras are perturbed by perturb_left.
///
/// No pull, and a cost that stays what it was (nothing at the start), have for the rest of the call:
/// observations behind their camera at the start or after a step, and those of a point that its observations
/// do not determine, as one pixel without disparity: such a point stays where it is. Without a fixed camera
/// the result's place (and scale, where no observation has a disparity) is what the damping made of the
/// start's.
///
/// PreconditionError for positions out of range, unusable observations, values that are not finite, a camera
/// that sees a point twice. Same bits at any number of threads.
[[nodiscard]] BundleReport adjust_bundle(BundleProblem& problem, const BundleOptions& options,
                                         const Executor& executor = Executor());

/// For each point its covariance in the world, square metres, from the sigmas of its observations with
/// `use_observation` (one for each observation, 1: use) that lie in front of their camera; the cameras taken
/// as exact, no kernel. Infinity on the diagonal and zeros beside it where they do not determine the point.
[[nodiscard]] std::vector<Eigen::Matrix3d> point_covariances(const BundleProblem& problem,
                                                             std::span<const char> use_observation,
                                                             const Executor& executor = Executor());

}  // namespace cairn
