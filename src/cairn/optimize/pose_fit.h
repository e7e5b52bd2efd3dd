// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/rig.h"
#include "cairn/optimize/robust_kernel.h"

namespace cairn {

enum class PoseFitMethod { gauss_newton, levenberg_marquardt };

struct PoseFitOptions {
  PoseFitMethod method = PoseFitMethod::levenberg_marquardt;
  RobustKernel kernel = RobustKernel::none;
  double kernel_scale = 2.448;   ///< standard deviations: the root of the 95 % limit of (u, v)
  int max_iterations = 50;       ///< 4 to 10 are usual
  double converged_step = 1e-6;  ///< radians and metres: far below what pixels determine

  /// PreconditionError for a value out of range.
  void validate() const;
};

struct PoseFitIteration {
  double cost = 0;    ///< half the sum of rho after the step
  double step = 0;    ///< length of the perturbation, 0 for the start
  double lambda = 0;  ///< damping of the step; 0 for the start and Gauss-Newton
  bool accepted = true;
};

enum class PoseFitStatus {
  ok,
  too_few_points,  ///< fewer than four
  undetermined,    ///< by the points, as where they lie on a line
  behind_camera,   ///< a point lies behind the camera at the start, or where Gauss-Newton went
  rising_cost,     ///< of Gauss-Newton: its step made it worse
  not_converged,   ///< within max_iterations
};

[[nodiscard]] std::string_view to_string(PoseFitStatus status);

struct PoseFit {
  PoseFitStatus status = PoseFitStatus::too_few_points;
  CameraFromWorld camera_from_world;    ///< the best so far where status is not ok
  std::vector<PoseFitIteration> trace;  ///< the start, then each step tried
  double cost = 0;                      ///< half the sum of rho(squared_error), as in the trace
  /// Of the left perturbation (rotation, translation) at the observations' sigmas: the inverse of J^T W J.
  /// With a kernel an approximation that counts down-weighted observations by their weight. Zero unless
  /// status is ok.
  Matrix6d covariance = Matrix6d::Zero();
  /// Twice the cost over the degrees of freedom: about 1 where the sigmas are right; the covariance times
  /// this is the one that the residuals suggest.
  double variance_factor = 0;

  [[nodiscard]] int iterations() const { return static_cast<int>(trace.size()) - 1; }
};

/// The pose of one camera with the least
///
///     1/2 sum_i rho(|S_i (pi(T X_i) - z_i)|^2)
///
/// over T = camera_from_world, all observations z_i = (u, v, d) used, S_i their inverse standard deviations.
/// Each step solves (J^T W J + lambda diag(J^T W J)) xi = -J^T W e with observation_jacobian, W the kernel's
/// weights, and moves T to perturb_left(xi, T); lambda is 0 for Gauss-Newton and follows Marquardt 1963
/// otherwise. Unlike refine_pose it leaves no observation out. PreconditionError for points and pixels that
/// are not finite. Deterministic, one thread.
[[nodiscard]] PoseFit fit_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                               std::span<const Observation> seen,
                               const CameraFromWorld& initial_camera_from_world,
                               const PoseFitOptions& options = {});

}  // namespace cairn
