// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "cairn/calibrate/stretches.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/pose_path.h"

namespace cairn {

/// Holds what is wrong between a camera and the poses of its subject: boresight w (3, radians) and lever arm
/// a (3, metres), both in the subject's axes, the camera's true pose on it being (exp(w) R, t + a) with the
/// stated R and t; how much longer the true motions are than those seen (1, a share); and seconds that have
/// to be added to the stamps of the poses (1).
using PoseTerms = Eigen::Matrix<double, 8, 1>;
enum PoseTerm { boresight_term = 0, lever_arm_term = 3, scale_term = 6, time_term = 7 };

/// Holds what a fit starts from. Refers to stretches and path.
struct PoseFitProblem {
  std::span<const Stretch> stretches;
  const PosePath& path;
  Rigid3 subject_from_camera;  ///< as stated
  bool with_time = true;       ///< whether the time offset is sought
  /// Standard deviations of the six residuals of a stretch; nullopt: measured from them.
  std::optional<Vector6d> scatter = std::nullopt;
};

/// Holds the result of fit_poses.
struct PoseFit {
  PoseTerms value = PoseTerms::Zero();
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Zero();  ///< with the prior
  Vector6d scatter = Vector6d::Zero();  ///< robust, rotation (radians) then translation (metres)
  int stretches = 0;                    ///< that have poses at both ends
};

/// Fits the terms so that the subject's motion G over each stretch, between poses at stamps shifted by the
/// time offset, moves the camera as seen: X^-1 G X = V, with the camera's pose X on the subject and V's
/// translation scaled. Gauss-Newton with Huber's weights; each of the six residuals (rotation vector and
/// translation, in the camera's axes) has the standard deviation that its own scatter shows. A prior about
/// the stated values keeps what the motion leaves open: 2 deg, 0.5 m, 5 %, 0.1 s. Stretches without poses are
/// left out. The covariance knows how residuals of neighbouring stretches correlate. The equation is that of
/// hand-eye calibration (Tsai and Lenz 1989).
[[nodiscard]] PoseFit fit_poses(const PoseFitProblem& problem);

}  // namespace cairn
