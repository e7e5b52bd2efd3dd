// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/options.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

void check(bool holds, const char* name, const char* expected, double found) {
  if (!holds)
    throw InputError({name, 0, expected, fmt::format("{}", found), "Leave it out for the default."});
}

bool positive(double value) {
  return value > 0 && std::isfinite(value);
}

bool is_share(double value) {
  return value >= 0 && value <= 1;
}

void validate_depth(const DepthNoise& depth, const StereoNoise& stereo) {
  check(positive(depth.baseline), "depth.virtual_baseline", "metres above 0", depth.baseline);
  check(positive(depth.sigma_disparity_px), "depth.sigma_disparity_px", "pixels above 0",
        depth.sigma_disparity_px);
  check(depth.min_depth >= 0, "depth.min", "metres from 0", depth.min_depth);
  check(depth.max_depth > depth.min_depth, "depth.max", "metres above depth.min", depth.max_depth);
  check(positive(stereo.min_depth), "stereo.min_depth", "metres above 0", stereo.min_depth);
  check(depth.jump_radius >= 0 && depth.jump_radius <= 100, "depth.jump_radius_px", "pixels from 0 to 100",
        depth.jump_radius);
  check(positive(depth.jump_sigmas), "depth.jump_sigmas", "standard deviations above 0", depth.jump_sigmas);
  check(stereo.min_disparity_sigmas >= 0, "stereo.min_disparity_sigmas", "standard deviations from 0",
        stereo.min_disparity_sigmas);
  check(stereo.sigma_floor_px >= 0, "stereo.sigma_floor_px", "pixels from 0", stereo.sigma_floor_px);
}

void validate_tracking(const TrackingOptions& tracking) {
  check(positive(tracking.motion_radius_px), "tracking.motion_radius_px", "pixels above 0",
        tracking.motion_radius_px);
  check(positive(tracking.map_radius_px), "tracking.map_radius_px", "pixels above 0", tracking.map_radius_px);
  check(tracking.local_keyframes >= 1, "tracking.local_keyframes", "at least 1 keyframe",
        tracking.local_keyframes);
  check(tracking.local_neighbours >= 0, "tracking.local_neighbours", "a number of keyframes from 0",
        tracking.local_neighbours);
}

void validate_mapping(const MappingOptions& mapping) {
  check(mapping.view_change >= 0, "mapping.view_change", "radians from 0", mapping.view_change);
  check(mapping.trial_keyframes >= 1, "mapping.trial_keyframes", "at least 1 keyframe",
        mapping.trial_keyframes);
  check(mapping.window_keyframes >= 1, "mapping.window_keyframes", "at least 1 keyframe",
        mapping.window_keyframes);
  check(mapping.window_fixed >= 0, "mapping.window_fixed", "a number of keyframes from 0",
        mapping.window_fixed);
  check(mapping.window_lag >= 0, "mapping.window_lag", "a number of frames from 0", mapping.window_lag);
  check(mapping.redundant_share > 0 && mapping.redundant_share <= 1, "mapping.redundant_share",
        "a share above 0, up to 1", mapping.redundant_share);
}

}  // namespace

void SlamOptions::validate() const {
  features.validate();
  validate_depth(depth_noise, stereo_noise);
  validate_tracking(tracking);
  validate_mapping(mapping);
  check(good_match_threshold >= 1, "good_match_threshold", "a factor of at least 1", good_match_threshold);
  check(min_good_match >= 4, "min_good_match", "at least 4 matches", min_good_match);
  check(min_inliers >= 4, "min_inliers", "at least 4 inliers", min_inliers);
  check(is_share(min_inlier_share), "min_inlier_share", "a share from 0 to 1", min_inlier_share);
  check(loop_min_inliers >= 4, "loop_min_inliers", "at least 4 inliers", loop_min_inliers);
  check(is_share(loop_min_inlier_share), "loop_min_inlier_share", "a share from 0 to 1",
        loop_min_inlier_share);
  check(positive(max_norm), "max_norm", "rad + m above 0", max_norm);
  check(positive(max_norm_lp), "max_norm_lp", "rad + m above 0", max_norm_lp);
  check(keyframe_threshold >= 0 && keyframe_threshold < max_norm, "keyframe_threshold",
        "rad + m from 0 to max_norm", keyframe_threshold);
  check(weak_tracking >= 0, "weak_tracking", "a number of inliers from 0", weak_tracking);
  check(place_loops >= 0, "place_loops", "a number of keyframes from 0", place_loops);
  check(nearby_loops >= 0, "nearby_loops", "a number of keyframes from 0", nearby_loops);
  check(random_loops >= 0, "random_loops", "a number of keyframes from 0", random_loops);
  check(relocalization_keyframes >= 1, "relocalization_keyframes", "at least 1 keyframe",
        relocalization_keyframes);
  check(lost_frames >= 1, "lost_frames", "at least 1 frame", lost_frames);
}

}  // namespace cairn
