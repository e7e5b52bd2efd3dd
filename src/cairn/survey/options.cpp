// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/options.h"

#include <string>

#include "cairn/core/parameter.h"

namespace cairn {
namespace {

void validate_tracks(const TrackOptions& tracks) {
  check_parameter(tracks.window >= 2, "window", "at least 2 frames", tracks.window);
  check_parameter(tracks.max_frames >= 3, "max_frames", "at least 3 frames", tracks.max_frames);
  check_parameter(tracks.smooth_frames >= 0 && tracks.smooth_frames < tracks.window, "smooth_frames",
                  "a number of frames from 0, less than the window", tracks.smooth_frames);
  check_parameter(is_positive(tracks.epipolar_px), "epipolar_px", "pixels above 0", tracks.epipolar_px);
  check_parameter(is_positive(tracks.search_px), "search_px", "pixels above 0", tracks.search_px);
  check_parameter(is_share(tracks.max_ratio), "max_ratio", "a ratio from 0 (off) to 1", tracks.max_ratio);
  check_parameter(tracks.min_view_change >= 0, "min_view_change", "radians from 0", tracks.min_view_change);
}

void validate_fit(const LandmarkFitOptions& fit) {
  check_parameter(fit.min_observations >= 2, "adjust.min_frames", "at least 2 frames", fit.min_observations);
  check_parameter(is_positive(fit.max_error), "adjust.max_error_sigmas", "standard deviations above 0",
                  fit.max_error);
}

void validate_limits(const std::string& name, const SpreadLimits& limits) {
  const auto check = [&](const std::optional<double>& bound, const char* which) {
    if (bound) check_parameter(*bound >= 0, (name + which).c_str(), "a number from 0", *bound);
  };
  check(limits.min, ".min");
  check(limits.max, ".max");
  check(limits.max_mean, ".max_mean");
  check(limits.max_std, ".max_std");
}

void validate_cleaning(const CleaningOptions& cleaning) {
  check_parameter(cleaning.min_frames >= 2, "clean.min_frames", "at least 2 frames", cleaning.min_frames);
  check_parameter(is_positive(cleaning.max_std_m), "clean.max_std_m", "metres above 0", cleaning.max_std_m);
  check_parameter(is_positive(cleaning.max_rms_px), "clean.max_rms_px", "pixels above 0",
                  cleaning.max_rms_px);
  check_parameter(cleaning.min_ray_angle_deg >= 0, "clean.min_ray_angle_deg", "degrees from 0",
                  cleaning.min_ray_angle_deg);
  validate_limits("clean.depth", cleaning.depth);
  validate_limits("clean.distance", cleaning.distance);
  validate_limits("clean.lateral", cleaning.lateral);
  validate_limits("clean.angle_deg", cleaning.angle_deg);
  check_parameter(cleaning.duplicate_sigmas >= 0, "clean.duplicate_sigmas", "standard deviations from 0",
                  cleaning.duplicate_sigmas);
}

}  // namespace

void SurveyOptions::validate() const {
  observer.validate();
  validate_tracks(tracks);
  validate_fit(fit);
  check_parameter(is_positive(covariance.sigma_px), "adjust.sigma_px", "pixels above 0", covariance.sigma_px);
  validate_cleaning(cleaning);
}

}  // namespace cairn
