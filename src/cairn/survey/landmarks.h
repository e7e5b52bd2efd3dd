// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/map/indicators.h"
#include "cairn/optimize/landmark_noise.h"
#include "cairn/optimize/variance_model.h"
#include "cairn/survey/tracks.h"

namespace cairn {

/// Holds an adjusted landmark.
struct SurveyLandmark {
  std::vector<ObservationRef> observations;  ///< observations that agree with the point, by frame
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  /// Covariance of the point, square metres, if the observations are as noisy as their standard deviations
  /// say and the poses exact.
  Eigen::Matrix3d cofactor = Eigen::Matrix3d::Zero();
  double squared_error_sum = 0;     ///< over the observations, in units of their standard deviations
  int redundancy = 0;               ///< number of measured values minus the three of the point
  double variance_factor = 1;       ///< a posteriori, see VarianceModel
  LandmarkInformation information;  ///< of the observations
  /// From the images, with what the observations have in common, see LandmarkNoise; square metres.
  Eigen::Matrix3d image_covariance = Eigen::Matrix3d::Zero();
  /// What the errors of the given poses add, square metres.
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();
  LandmarkIndicators indicators;

  /// Returns the covariance if the errors of the observations were independent, square metres. It tells
  /// landmarks apart, because what they have in common moves neighbouring landmarks alike.
  [[nodiscard]] Eigen::Matrix3d own_covariance() const { return variance_factor * cofactor; }
  /// Returns the covariance of the point in the world, square metres.
  [[nodiscard]] Eigen::Matrix3d covariance() const { return image_covariance + pose_covariance; }
};

/// Holds the landmarks made of tracks, and counts the tracks of which none was made.
struct AdjustedTracks {
  std::vector<SurveyLandmark> landmarks;  ///< in the order of the tracks
  std::int64_t too_short = 0;             ///< tracks of fewer frames than a landmark needs
  std::int64_t inconsistent = 0;          ///< tracks with too few observations that agree with one point
  std::int64_t dropped_observations = 0;  ///< observations of landmarks that do not agree with their points
};

/// Returns observations with the positions of their frames in the buffer as numbers of their cameras.
[[nodiscard]] std::vector<CameraObservation> with_positions(const FrameBuffer& frames,
                                                            std::span<const ObservationRef> observations);

/// Fits a point to the observations, whose frames are in the buffer, see LandmarkSolver. Returns nullopt if
/// too few agree.
[[nodiscard]] std::optional<SurveyLandmark> fit_observations(const Rig& rig, const FrameBuffer& frames,
                                                             std::span<const ObservationRef> observations,
                                                             const SurveyOptions& options);

/// Fits a point to each of the tracks, whose frames are in the buffer. The same bits at any number of
/// threads.
[[nodiscard]] AdjustedTracks adjust_tracks(const Rig& rig, const FrameBuffer& frames,
                                           std::span<const Track> tracks, const SurveyOptions& options,
                                           const Executor& executor);

/// Returns the observations, as stored in a map, with the poses of their cameras. `cameras` are of the frames
/// in the buffer, in order.
[[nodiscard]] std::vector<PosedObservation> views_of(const FrameBuffer& frames,
                                                     std::span<const CameraFromWorld> cameras,
                                                     std::span<const ObservationRef> observations);

/// Holds what is known of the noise of all landmarks' observations.
struct NoisePrior {
  VariancePrior variance;
  LandmarkNoise noise;
};

/// Sets the variance factor, the covariance from the images and, if `pose_errors` is true, what the errors of
/// the given poses add to the covariance, zero if they state none. GNSS/INS errors change slowly, so that the
/// poses of one landmark err alike: the mean of what each pose alone would add, dX = c + w x (X - p) with
/// PoseUncertainty's (c, w), does not shrink with the number of frames. What changes from frame to frame is
/// in the residuals, and so in the variance factor.
void complete_covariance(const FrameBuffer& frames, const NoisePrior& prior, bool pose_errors,
                         SurveyLandmark& landmark);

}  // namespace cairn
