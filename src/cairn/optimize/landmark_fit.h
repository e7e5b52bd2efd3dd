// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/optimize/packed_observations.h"
#include "cairn/simd/instruction_set.h"

namespace cairn {

struct LandmarkFitOptions {
  int min_observations = 3;  ///< fewer make no landmark, because nothing would show that one of them is wrong
  double max_error = 4;      ///< standard deviations, root of squared_error: 1e-3 of chi-square(3) is above
  int max_iterations =
      50;  ///< steps tried for one solution; 2 or 3 are usual, and many where depth is hardly known
  double converged_step = 1e-8;  ///< metres: done when the next step would be shorter

  /// PreconditionError for a value out of range.
  void validate() const;
};

enum class LandmarkFitStatus {
  ok,
  too_few,        ///< fewer than min_observations are left
  undetermined,   ///< by what is left: rays that are parallel, and no disparity
  not_converged,  ///< within max_iterations
};

[[nodiscard]] std::string_view to_string(LandmarkFitStatus status);

struct LandmarkFit {
  LandmarkFitStatus status = LandmarkFitStatus::too_few;
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();  ///< the best so far where status is not ok
  /// Of the point in the world, square metres, from the observations' sigmas alone: cameras are exact, and it
  /// is not scaled by the residuals. Zero unless status is ok.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double squared_error_sum = 0;  ///< over the kept observations, in variances; 0 where they are too few
  int redundancy = 0;            ///< numbers measured by the kept observations, less 3
  double rms_px = 0;             ///< of the distance in (u, v) over the kept ones; 0 where they are too few
  std::vector<char> kept;        ///< one for each observation, 1: used
  int iterations = 0;            ///< steps tried for the last solution
};

/// The landmark X with the least
///
///     sum_i |S_i (pi(T_i X) - z_i)|^2
///
/// over the observations z_i = (u, v, d) from cameras T_i = camera_from_world, which stay where they are; S_i
/// are the inverse standard deviations. While an observation's error at the solution is above max_error, the
/// worst one is dropped, and the solution is sought again from the initial value. That is an observation
/// back-projected by its disparity, or two intersected; once observations are to be dropped it is the one of
/// these with the least median error (Rousseeuw 1984). Each solution begins with equations that are linear in
/// X (Hartley and Sturm 1997) and goes on with Gauss-Newton steps, damped where they do not lower the cost
/// (Marquardt 1963).
///
/// Deterministic: the same bits on all instruction sets. Not to be used by two threads at a time; the second
/// has a solver of its own. Apart from `fit.kept`, nothing is allocated once the longest track was seen.
class LandmarkSolver {
 public:
  /// PreconditionError for poses that are not finite, or focal lengths and a baseline not above 0.
  LandmarkSolver(const Rig& rig, std::span<const CameraFromWorld> cameras,
                 const LandmarkFitOptions& options = {}, InstructionSet set = default_instruction_set());
  ~LandmarkSolver();
  LandmarkSolver(LandmarkSolver&&) noexcept;
  LandmarkSolver& operator=(LandmarkSolver&&) noexcept;

  /// Fills `fit`, whose memory is used again. PreconditionError for a camera out of range, pixels that are
  /// not finite, sigmas not above 0. A disparity that is not above 0 is a measurement like others.
  void fit(std::span<const CameraObservation> observations, LandmarkFit& fit);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

/// One landmark with a solver of its own. For many, LandmarkSolver is faster.
[[nodiscard]] LandmarkFit fit_landmark(const Rig& rig, std::span<const CameraFromWorld> cameras,
                                       std::span<const CameraObservation> observations,
                                       const LandmarkFitOptions& options = {});

}  // namespace cairn
