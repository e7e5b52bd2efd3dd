// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/parameter.h"
#include "cairn/observe/observer.h"
#include "cairn/optimize/landmark_fit.h"

namespace cairn {

/// Holds the options of tracking features.
struct TrackOptions {
  /// Number of frames without a measured disparity after which a track is finished. It bounds the memory; few
  /// features come back later, and become two landmarks, which are merged.
  int window = 20;
  /// Number of frames with which poses are adjusted at a time, and that an adjustment knows before and after
  /// them, see adjust_poses; 0: poses stay as given.
  int pose_frames = 20;
  /// Maximum length of a track, frames; at this length it is closed and a new one begins. Longer tracks add
  /// little accuracy, but keep frames in memory.
  int max_frames = 50;
  /// Largest distance from the epipolar line, pixels, times the larger scale of the two keypoints.
  double epipolar_px = 2;
  /// Search radius around the predicted pixel, at the finest scale, plus what the depth leaves open.
  double search_px = 4;
  /// Largest ratio of the distances to the nearest and the second nearest descriptor within the search radius
  /// (Lowe 2004, sec. 7.1).
  double max_ratio = 0.9;
  /// Smallest change of the view, rotation in radians plus translation over the median depth; a frame that
  /// changes it by less since the last one used is left out. A car that waits makes no landmarks of fifty
  /// frames from one position.
  double min_view_change = 0.004;
};

/// Holds the options of the landmarks' covariances.
struct CovarianceOptions {
  /// Standard deviation of u and v of a feature of the finest scale, pixels; times the scale for other
  /// features. The variance factor corrects it if the images disagree.
  double sigma_px = 0.5;
  bool pose_errors = true;  ///< add what the stated deviations of the given poses, if any, make of a landmark
};

/// Holds the limits on one quantity over the observations of a landmark; unset: no limit.
struct ValueLimits {
  std::optional<double> min;       ///< smallest value of each observation
  std::optional<double> max;       ///< largest value of each observation
  std::optional<double> max_mean;  ///< largest mean
  std::optional<double> max_std;   ///< largest standard deviation
};

/// Holds the options of cleaning: which landmarks are kept, and when two are merged.
struct CleaningOptions {
  int min_frames = 3;  ///< fewest frames: two agree by chance along the line, a third confirms or refutes
  /// Largest standard deviation along the worst direction, metres, by the landmark's own covariance, that is,
  /// without what the given poses' deviations add: a camera that is resected from less certain landmarks
  /// gains nothing, whereas the errors of poses move neighbouring landmarks alike.
  double max_std_m = 0.5;
  /// Largest RMS residual of (u, v), three times that of good features: something moved, or two things were
  /// taken as one.
  double max_rms_px = 1.5;
  /// Smallest value of the largest angle between two rays, degrees; below, the depth rests on the disparity
  /// alone.
  double min_ray_angle_deg = 0.2;
  /// Depth along the optical axis, metres.
  ValueLimits depth{.min = 0.3, .max = 100, .max_mean = {}, .max_std = {}};
  /// Distance from the camera, metres.
  ValueLimits distance{.min = {}, .max = 120, .max_mean = {}, .max_std = {}};
  /// Distance from the optical axis, metres.
  ValueLimits lateral{.min = {}, .max = 60, .max_mean = {}, .max_std = {}};
  /// Angle between ray and optical axis, degrees; far from the axis, lenses are badly calibrated.
  ValueLimits angle_deg{.min = {}, .max = 60, .max_mean = {}, .max_std = {}};
  /// Largest difference of two landmarks that are merged, standard deviations (chi-square with 3 degrees of
  /// freedom, 95 %), if they look alike and one point fits all observations.
  double duplicate_sigmas = 2.8;
};

/// Holds the options of mapping with known poses.
struct SurveyOptions {
  /// Options of observing frames. Many features, also of low contrast, and a partner for each however the
  /// right image looks: a wrong partner contradicts the other frames.
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
