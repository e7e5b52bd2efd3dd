// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/optimize/bundle_adjustment.h"

namespace cairn {

/// Names the motion from one camera of a problem to another one, positions in camera_from_world.
struct CameraMotion {
  std::int32_t from = 0, to = 0;
};

/// Holds how sure the motions of an adjusted problem are, one entry for each motion that was asked for:
/// covariances of the left perturbation (rotation in radians, then position in metres, in the axes of `to`)
/// of to_from_from, the error of the estimate against the truth.
struct CameraCovariances {
  bool determined = false;  ///< if not, both lists are empty
  /// From the standard deviations that the observations state, as independent errors: exact marginals of the
  /// adjustment with the weights of the kernel, points estimated with the cameras.
  std::vector<Matrix6d> formal;
  /// From what the residuals show, errors in common included (camera_covariances).
  std::vector<Matrix6d> covariances;
};

/// Says if the disparities share a field that was estimated with the cameras (DisparityField).
enum class SharedField {
  none,       ///< no field was taken off
  estimated,  ///< what was found was taken off: its error is one of the covariances
};

/// Computes the covariances of `motions` in an adjusted problem from its observations with `use_observation`
/// (one for each observation, 1 to use it). A fixed camera is exact.
///
/// Observations err together: those of one point, whose centre wanders with the view, those of corners that
/// lie close to each other, and all in one part of the image, by what calibration and depth leave. So the
/// covariances are not from the standard deviations that observations state, but from how much the points of
/// each part of the image pull at the motion: a sandwich estimate with clusters (Liang and Zeger 1986,
/// "Longitudinal data analysis using generalized linear models"). The clusters are the cells of a grid of 12
/// by 8 over the image, and a point is in that of its mean pixel. With S the equations of the cameras, g_c
/// the gradient of cell c and y_c = S^-1 g_c, the sum of y_c y_c^T estimates the covariance M. With F the
/// formal covariance, a_c = y_c^T F^-1 y_c and n = (sum a_c)^2 / sum a_c^2, M is worth n cells that pull
/// alike (Satterthwaite 1946). So few give its shape badly: it is averaged with F scaled to the same size, F
/// sum a_c / 6, as n to 96. And all is enlarged by (n + 6) / n, because the motion itself took six numbers of
/// them.
///
/// If a field of the disparities was estimated, it is one of the unknowns here too, with a prior of 1 px on
/// each coefficient. In any case, what the residuals still show of a field adds to the covariance as a bias
/// of unknown sign, if it is larger than its own error in 99 of 100 cases.
///
/// Errors that change no residual are not known here: of the baseline or the scale of depth, and what all
/// observations of one image have in common and its pose takes up.
///
/// Not determined if no camera is fixed, none is free, or the observations leave a camera free to move.
/// Throws PreconditionError if the problem is invalid, `use_observation` has another length or a motion is
/// not of two cameras. Gives the same bits at any number of threads.
[[nodiscard]] CameraCovariances camera_covariances(const BundleProblem& problem,
                                                   std::span<const char> use_observation,
                                                   std::span<const CameraMotion> motions, SharedField field,
                                                   const Executor& executor = Executor());

/// Computes the adjoint A of a transform T = target_from_source: perturb_left(A xi, T) is, to first order,
/// T after the perturbation xi of the source.
[[nodiscard]] Matrix6d adjoint(const Rigid3& target_from_source);

}  // namespace cairn
