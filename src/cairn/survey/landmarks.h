// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/map/indicators.h"
#include "cairn/survey/tracks.h"
#include "cairn/survey/variance_model.h"

namespace cairn {

/// A landmark that was adjusted.
struct SurveyLandmark {
  std::vector<ObservationRef> observations;  ///< those that agree with the point, by frame
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  /// Of the point, square metres, for observations as noisy as their sigmas say and exact poses.
  Eigen::Matrix3d cofactor = Eigen::Matrix3d::Zero();
  double squared_error_sum = 0;  ///< of the observations, in units of their standard deviations
  int redundancy = 0;            ///< numbers measured, without the three of the point
  double variance_factor = 1;    ///< a posteriori, see VarianceModel
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< what the poses' errors add, square metres
  LandmarkIndicators indicators;

  /// What the images leave open. It tells landmarks apart: the errors of poses move neighbours alike.
  [[nodiscard]] Eigen::Matrix3d own_covariance() const { return variance_factor * cofactor; }
  /// Of the point in the world.
  [[nodiscard]] Eigen::Matrix3d covariance() const { return own_covariance() + pose_covariance; }
};

/// What became of tracks.
struct AdjustedTracks {
  std::vector<SurveyLandmark> landmarks;  ///< in the tracks' order
  std::int64_t too_short = 0;             ///< tracks of fewer frames than a landmark needs
  std::int64_t inconsistent = 0;          ///< too few observations agree with one point
  std::int64_t dropped_observations = 0;  ///< of landmarks: those that disagree
};

/// The frame in whose surroundings a landmark's cameras are taken, see cameras_around.
[[nodiscard]] KeyframeId middle_of(std::span<const ObservationRef> observations);

/// Fits a point to what the observations show, whose frames are in the buffer, see LandmarkSolver; nothing
/// where too few agree.
[[nodiscard]] std::optional<SurveyLandmark> fit_observations(const Rig& rig, const FrameBuffer& frames,
                                                             std::span<const ObservationRef> observations,
                                                             const SurveyOptions& options);

/// The same for each of the tracks. The same bits at any number of threads.
[[nodiscard]] AdjustedTracks adjust_tracks(const Rig& rig, const FrameBuffer& frames,
                                           std::span<const Track> tracks, const SurveyOptions& options,
                                           const Executor& executor);

/// The observations with their cameras.
[[nodiscard]] std::vector<PosedObservation> views_of(const FrameBuffer& frames,
                                                     std::span<const CameraFromWorld> cameras,
                                                     std::span<const ObservationRef> observations);

/// Sets what its covariance is made of beside the cofactor. What the errors of the given poses add is zero
/// where none are given. GNSS/INS errors change slowly, so that the poses of one landmark err alike: the mean
/// of what each pose alone would add, dX = c + w x (X - p) with PoseUncertainty's (c, w), does not shrink
/// with the number of frames. What changes from frame to frame is in the residuals, and so in the variance
/// factor.
void complete_covariance(const FrameBuffer& frames, const VariancePrior& prior, bool pose_errors,
                         SurveyLandmark& landmark);

}  // namespace cairn
