// SPDX-License-Identifier: Apache-2.0
#include "slam_parameters.h"

#include "observer_parameters.h"

namespace cairn::app {
namespace {

void bind_slam(SlamOptions& slam, SettingTable& table) {
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

}  // namespace

SettingTable SlamParameters::table() {
  SettingTable table;
  bind_sequence(sequence, table);
  bind_observer(slam.observer, table);
  bind_slam(slam, table);
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
