// SPDX-License-Identifier: Apache-2.0
#include "map_parameters.h"

#include <string>

#include "observer_parameters.h"

namespace cairn::app {
namespace {

void bind_tracks(TrackOptions& tracks, SettingTable& table) {
  table.bind("window", tracks.window);
  table.bind("smooth_frames", tracks.smooth_frames);
  table.bind("max_frames", tracks.max_frames);
  table.bind("epipolar_px", tracks.epipolar_px);
  table.bind("search_px", tracks.search_px);
  table.bind("max_ratio", tracks.max_ratio);
  table.bind("min_view_change", tracks.min_view_change);
}

void bind_adjustment(SurveyOptions& survey, SettingTable& table) {
  table.bind("adjust.min_frames", survey.fit.min_observations);
  table.bind("adjust.max_error_sigmas", survey.fit.max_error);
  table.bind("adjust.sigma_px", survey.covariance.sigma_px);
  table.bind("adjust.pose_errors", survey.covariance.pose_errors);
}

void bind_limits(const std::string& name, SpreadLimits& limits, SettingTable& table) {
  table.bind(name + ".min", limits.min);
  table.bind(name + ".max", limits.max);
  table.bind(name + ".max_mean", limits.max_mean);
  table.bind(name + ".max_std", limits.max_std);
}

void bind_cleaning(CleaningOptions& cleaning, SettingTable& table) {
  table.bind("clean.min_frames", cleaning.min_frames);
  table.bind("clean.max_std_m", cleaning.max_std_m);
  table.bind("clean.max_rms_px", cleaning.max_rms_px);
  table.bind("clean.min_ray_angle_deg", cleaning.min_ray_angle_deg);
  bind_limits("clean.depth", cleaning.depth, table);
  bind_limits("clean.distance", cleaning.distance, table);
  bind_limits("clean.lateral", cleaning.lateral, table);
  bind_limits("clean.angle_deg", cleaning.angle_deg, table);
  table.bind("clean.duplicate_sigmas", cleaning.duplicate_sigmas);
}

}  // namespace

SettingTable MapParameters::table() {
  SettingTable table;
  bind_sequence(sequence, table);
  bind_observer(survey.observer, table);
  bind_tracks(survey.tracks, table);
  bind_adjustment(survey, table);
  bind_cleaning(survey.cleaning, table);
  return table;
}

}  // namespace cairn::app
