// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/optimize/packed_observations.h"
#include "cairn/simd/instruction_set.h"

namespace cairn {

/// Sets which observations a landmark keeps and when its fit has converged.
struct LandmarkFitOptions {
  int min_observations = 3;  ///< fewer make no landmark, because nothing would reveal a wrong one among them
  double max_error = 4;  ///< root of squared_error, standard deviations: exceeded by 1e-3 of chi-square(3)
  /// Steps tried for one solution; 2 or 3 are usual, many if the depth is poorly determined.
  int max_iterations = 50;
  double converged_step = 1e-8;  ///< metres; converged if the next step would be shorter

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Says if a landmark was fitted and, if not, why.
enum class LandmarkFitStatus {
  ok,
  too_few,        ///< fewer than min_observations remain
  undetermined,   ///< the remaining observations do not determine the point: parallel rays, no disparity
  not_converged,  ///< not converged within max_iterations
};

[[nodiscard]] std::string_view to_string(LandmarkFitStatus status);

/// Holds the result of LandmarkSolver::fit.
struct LandmarkFit {
  LandmarkFitStatus status = LandmarkFitStatus::too_few;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();  ///< the best so far if status is not ok
  /// Covariance of the point in the world, square metres, from the standard deviations of the observations
  /// alone: cameras are taken as exact, and it is not scaled by the residuals. Zero unless status is ok.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double squared_error_sum = 0;  ///< over the kept observations, in variances; 0 if status is too_few
  int redundancy = 0;            ///< number of coordinates measured by the kept observations, less 3
  /// Root mean square distance of (u, v) of the kept observations; 0 if status is too_few.
  double rms_px = 0;
  std::vector<char> kept;  ///< one for each observation, 1: used
  int iterations = 0;      ///< steps tried for the last solution
};

/// Fits landmarks: the X with the least
///
///     sum_i |S_i (pi(T_i X) - z_i)|^2
///
/// over the observations z_i = (u, v, d) from fixed cameras T_i = camera_from_world; S_i are the inverse
/// standard deviations. While an observation's error at the solution is above max_error, the worst one is
/// dropped and the solution is sought again from the initial value. That is an observation back-projected by
/// its disparity, or the intersection of two rays; once observations are to be dropped, it is the candidate
/// with the least median error (Rousseeuw 1984). Each solution begins with equations that are linear in X
/// (Hartley and Sturm 1997) and continues with Newton steps, damped if they do not lower the cost (Marquardt
/// 1963).
///
/// Deterministic: the same bits on all instruction sets. Each thread needs a solver of its own. Apart from
/// `fit.kept`, nothing is allocated once the longest track was seen.
class LandmarkSolver {
 public:
  /// Prepares fits with these cameras. Throws PreconditionError if a pose is not finite, focal lengths or
  /// baseline are not above 0, or an option is out of range.
  LandmarkSolver(const Rig& rig, std::span<const CameraFromWorld> cameras,
                 const LandmarkFitOptions& options = {}, InstructionSet set = default_instruction_set());
  ~LandmarkSolver();
  LandmarkSolver(LandmarkSolver&&) noexcept;
  LandmarkSolver& operator=(LandmarkSolver&&) noexcept;

  /// Fits one landmark into `fit`, whose memory is reused. Throws PreconditionError if a camera is out of
  /// range, a pixel is not finite, or a standard deviation is not above 0. A disparity that is not above 0 is
  /// a measurement like any other.
  void fit(std::span<const CameraObservation> observations, LandmarkFit& fit);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// Fits one landmark with a solver of its own; LandmarkSolver is faster for many.
[[nodiscard]] LandmarkFit fit_landmark(const Rig& rig, std::span<const CameraFromWorld> cameras,
                                       std::span<const CameraObservation> observations,
                                       const LandmarkFitOptions& options = {});

}  // namespace cairn
