// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/options.h"

#include "cairn/core/parameter.h"

namespace cairn {
namespace {

void validate_tracking(const TrackingOptions& tracking) {
  check_parameter(is_positive(tracking.motion_radius_px), "tracking.motion_radius_px", "pixels above 0",
                  tracking.motion_radius_px);
  check_parameter(is_positive(tracking.map_radius_px), "tracking.map_radius_px", "pixels above 0",
                  tracking.map_radius_px);
  check_parameter(tracking.local_keyframes >= 1, "tracking.local_keyframes", "at least 1 keyframe",
                  tracking.local_keyframes);
  check_parameter(tracking.local_neighbours >= 0, "tracking.local_neighbours", "a number of keyframes from 0",
                  tracking.local_neighbours);
}

void validate_mapping(const MappingOptions& mapping) {
  check_parameter(mapping.view_change >= 0, "mapping.view_change", "radians from 0", mapping.view_change);
  check_parameter(mapping.trial_keyframes >= 1, "mapping.trial_keyframes", "at least 1 keyframe",
                  mapping.trial_keyframes);
  check_parameter(mapping.window_keyframes >= 1, "mapping.window_keyframes", "at least 1 keyframe",
                  mapping.window_keyframes);
  check_parameter(mapping.window_fixed >= 0, "mapping.window_fixed", "a number of keyframes from 0",
                  mapping.window_fixed);
  check_parameter(mapping.window_lag >= 0, "mapping.window_lag", "a number of frames from 0",
                  mapping.window_lag);
  check_parameter(mapping.redundant_share > 0 && mapping.redundant_share <= 1, "mapping.redundant_share",
                  "a share above 0, up to 1", mapping.redundant_share);
}

}  // namespace

void SlamOptions::validate() const {
  observer.validate();
  validate_tracking(tracking);
  validate_mapping(mapping);
  check_parameter(good_match_threshold >= 1, "good_match_threshold", "a factor of at least 1",
                  good_match_threshold);
  check_parameter(min_good_match >= 4, "min_good_match", "at least 4 matches", min_good_match);
  check_parameter(min_inliers >= 4, "min_inliers", "at least 4 inliers", min_inliers);
  check_parameter(is_share(min_inlier_share), "min_inlier_share", "a share from 0 to 1", min_inlier_share);
  check_parameter(loop_min_inliers >= 4, "loop_min_inliers", "at least 4 inliers", loop_min_inliers);
  check_parameter(is_share(loop_min_inlier_share), "loop_min_inlier_share", "a share from 0 to 1",
                  loop_min_inlier_share);
  check_parameter(is_positive(max_norm), "max_norm", "rad + m above 0", max_norm);
  check_parameter(frame_period_s >= 0, "frame_period_s", "seconds from 0", frame_period_s);
  check_parameter(is_positive(max_norm_lp), "max_norm_lp", "rad + m above 0", max_norm_lp);
  check_parameter(keyframe_threshold >= 0, "keyframe_threshold", "rad + m from 0", keyframe_threshold);
  check_parameter(weak_tracking >= 0, "weak_tracking", "a number of inliers from 0", weak_tracking);
  check_parameter(place_loops >= 0, "place_loops", "a number of keyframes from 0", place_loops);
  check_parameter(nearby_loops >= 0, "nearby_loops", "a number of keyframes from 0", nearby_loops);
  check_parameter(random_loops >= 0, "random_loops", "a number of keyframes from 0", random_loops);
  check_parameter(relocalization_keyframes >= 1, "relocalization_keyframes", "at least 1 keyframe",
                  relocalization_keyframes);
  check_parameter(lost_frames >= 1, "lost_frames", "at least 1 frame", lost_frames);
}

}  // namespace cairn
