// SPDX-License-Identifier: Apache-2.0
#include "observer_parameters.h"

namespace cairn::app {
namespace {

void bind_stereo(StereoNoise& noise, SettingTable& table) {
  table.bind("stereo.min_depth", noise.min_depth);
  table.bind("stereo.min_correlation", noise.min_correlation);
  table.bind("stereo.min_disparity_sigmas", noise.min_disparity_sigmas);
  table.bind("stereo.sigma_floor_px", noise.sigma_floor_px);
}

void bind_depth(DepthNoise& noise, SettingTable& table) {
  table.bind("depth.virtual_baseline", noise.baseline);
  table.bind("depth.sigma_disparity_px", noise.sigma_disparity_px);
  table.bind("depth.jump_radius_px", noise.jump_radius);
  table.bind("depth.jump_sigmas", noise.jump_sigmas);
  table.bind("depth.min", noise.min_depth);
  table.bind("depth.max", noise.max_depth);
}

}  // namespace

void bind_sequence(SequenceOptions& sequence, SettingTable& table) {
  table.bind("camera.fx", sequence.camera_parameters.fx);
  table.bind("camera.fy", sequence.camera_parameters.fy);
  table.bind("camera.cx", sequence.camera_parameters.cx);
  table.bind("camera.cy", sequence.camera_parameters.cy);
  table.bind("camera.scale", sequence.camera_parameters.scale);
  table.bind("start_index", sequence.start_index);
  table.bind("end_index", sequence.end_index);
  table.bind("rgb_dir", sequence.rgb_dir);
  table.bind("rgb_extension", sequence.rgb_extension);
  table.bind("depth_dir", sequence.depth_dir);
  table.bind("depth_extension", sequence.depth_extension);
  table.bind("max_stamp_gap_s", sequence.max_stamp_gap_s);
}

void bind_observer(ObserverOptions& observer, SettingTable& table) {
  table.bind("detector", observer.features.detector);
  table.bind("descriptor", observer.features.descriptor);
  table.bind("features", observer.features.count);
  table.bind("contrast", observer.features.contrast);
  bind_depth(observer.depth_noise, table);
  bind_stereo(observer.stereo_noise, table);
}

}  // namespace cairn::app
