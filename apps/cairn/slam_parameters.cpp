// SPDX-License-Identifier: Apache-2.0
#include "slam_parameters.h"

namespace cairn::app {
namespace {

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

void bind_slam(SlamOptions& slam, SettingTable& table) {
  table.bind("detector", slam.observer.features.detector);
  table.bind("descriptor", slam.observer.features.descriptor);
  table.bind("features", slam.observer.features.count);
  table.bind("good_match_threshold", slam.good_match_threshold);
  table.bind("min_good_match", slam.min_good_match);
  table.bind("min_inliers", slam.min_inliers);
  table.bind("min_inlier_share", slam.min_inlier_share);
  table.bind("max_norm", slam.max_norm);
  table.bind("max_norm_lp", slam.max_norm_lp);
  table.bind("keyframe_threshold", slam.keyframe_threshold);
  table.bind("weak_tracking", slam.weak_tracking);
  table.bind("check_loop_closure", slam.check_loop_closure);
  table.bind("place_loops", slam.place_loops);
  table.bind("nearby_loops", slam.nearby_loops);
  table.bind("random_loops", slam.random_loops);
  table.bind("loop_min_inliers", slam.loop_min_inliers);
  table.bind("loop_min_inlier_share", slam.loop_min_inlier_share);
  table.bind("relocalization_keyframes", slam.relocalization_keyframes);
  table.bind("lost_frames", slam.lost_frames);
}

void bind_tracking(TrackingOptions& tracking, SettingTable& table) {
  table.bind("tracking.motion_radius_px", tracking.motion_radius_px);
  table.bind("tracking.map_radius_px", tracking.map_radius_px);
  table.bind("tracking.local_keyframes", tracking.local_keyframes);
  table.bind("tracking.local_neighbours", tracking.local_neighbours);
}

void bind_mapping(MappingOptions& mapping, SettingTable& table) {
  table.bind("mapping.view_change", mapping.view_change);
  table.bind("mapping.trial_keyframes", mapping.trial_keyframes);
  table.bind("mapping.triangulate", mapping.triangulate);
  table.bind("mapping.window_keyframes", mapping.window_keyframes);
  table.bind("mapping.window_fixed", mapping.window_fixed);
  table.bind("mapping.window_lag", mapping.window_lag);
  table.bind("mapping.redundant_share", mapping.redundant_share);
}

void bind_stereo(StereoNoise& noise, SettingTable& table) {
  table.bind("stereo.min_depth", noise.min_depth);
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

SettingTable SlamParameters::table() {
  SettingTable table;
  bind_sequence(sequence, table);
  bind_slam(slam, table);
  bind_depth(slam.observer.depth_noise, table);
  bind_stereo(slam.observer.stereo_noise, table);
  bind_tracking(slam.tracking, table);
  bind_mapping(slam.mapping, table);
  table.bind("voxel_grid", cloud.voxel_size);
  table.bind("cloud.max_depth", cloud.max_depth);
  table.bind("octree.resolution", octree.resolution);
  table.bind("octree.max_range", octree.max_range);
  return table;
}

void SlamParameters::validate() const {
  slam.validate();
  cloud.validate();
  octree.validate();
}

}  // namespace cairn::app
