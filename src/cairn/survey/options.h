// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/parameter.h"
#include "cairn/observe/observer.h"
#include "cairn/optimize/landmark_fit.h"

namespace cairn {

/// How features become tracks.
struct TrackOptions {
  /// Frames: a landmark that was not seen for so many is finished. It bounds the memory; few come back after
  /// more, and these become two landmarks, which are merged.
  int window = 20;
  /// Frames on either side, whose poses and motions smooth a pose, see smoothed_pose; 0: poses stay as given.
  /// Less than the window, so that a track's poses are smooth before it is adjusted.
  int smooth_frames = 10;
  /// Frames: a track spans fewer, and then begins anew. More would hardly make it surer, and hold the memory.
  int max_frames = 50;
  double epipolar_px = 2;  ///< largest distance from the epipolar line, times the larger keypoint's scale
  double search_px = 4;  ///< around the predicted place, plus what the depth leaves open, at the lowest level
  double max_ratio = 0.9;  ///< nearest to second nearest descriptor within the window (Lowe 2004, sec. 7.1)
  /// Radians, plus the way over the median depth: a frame that changes the view by less since the last one
  /// shows nothing new. A car that waits makes no landmarks of fifty frames from one place.
  double min_view_change = 0.004;
};

/// How sure a landmark is.
struct CovarianceOptions {
  /// Pixels, of u and v of a feature of the lowest level; times the level's scale for the others. Where the
  /// images say otherwise, the variance factor corrects it.
  double sigma_px = 0.5;
  bool pose_errors = true;  ///< the given poses' own standard deviations enter, where there are any
};

/// Bounds for the four figures that the observations of a landmark have of one thing; unset: none.
struct ValueLimits {
  std::optional<double> min;       ///< no observation below
  std::optional<double> max;       ///< none above
  std::optional<double> max_mean;  ///< of the mean
  std::optional<double> max_std;   ///< of the standard deviation
};

/// Which landmarks are worth keeping.
struct CleaningOptions {
  int min_frames = 3;  ///< two agree by chance along the line; a third confirms or refutes
  /// Metres, along the worst direction, by the landmark's own covariance, that is, without what the given
  /// poses' deviations add: a camera that is resected by less certain ones gains nothing, whereas the errors
  /// of poses move neighbouring landmarks alike.
  double max_std_m = 0.5;
  double max_rms_px = 1.5;  ///< three times what good features have: something moved, or two things were one
  double min_ray_angle_deg =
      0.2;  ///< largest angle between two rays: below, the depth rests on the disparity alone
  ValueLimits depth{.min = 0.3, .max = 100, .max_mean = {}, .max_std = {}};    ///< metres
  ValueLimits distance{.min = {}, .max = 120, .max_mean = {}, .max_std = {}};  ///< metres
  ValueLimits lateral{
      .min = {}, .max = 60, .max_mean = {}, .max_std = {}};  ///< metres, from the optical axis
  ValueLimits angle_deg{.min = {},
                        .max = 60,
                        .max_mean = {},
                        .max_std = {}};  ///< between ray and optical axis: beyond, lenses are badly known
  /// Two landmarks are one where their difference is at most so many standard deviations (chi-square with 3
  /// degrees of freedom, 95 %), they look the same, and one point fits all observations.
  double duplicate_sigmas = 2.8;
};

/// Mapping with known poses.
struct SurveyOptions {
  /// Many features, dim ones too, and of each its partner, however the right image looks: a wrong one among
  /// them contradicts the other frames.
  ObserverOptions observer{
      .features = {.detector = "SIFT", .descriptor = "SIFT", .count = 4000, .contrast = 0.01},
      .depth_noise = {},
      .stereo_noise = {.min_correlation = 0.7, .search_images = true}};
  TrackOptions tracks;
  LandmarkFitOptions fit;
  CovarianceOptions covariance;
  CleaningOptions cleaning;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of mapping with known poses, in the order of config.yaml, with those of the
/// observer.
void visit(SurveyOptions& options, ParameterVisitor& visitor);

}  // namespace cairn
