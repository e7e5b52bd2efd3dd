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

}  // namespace

void SlamOptions::validate() const {
  features.validate();
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  check(positive(depth_noise.baseline), "depth_noise.baseline", "metres above 0", depth_noise.baseline);
  check(positive(depth_noise.sigma_disparity_px), "depth_noise.sigma_disparity_px", "pixels above 0",
        depth_noise.sigma_disparity_px);
  check(depth_noise.min_depth >= 0, "min_depth", "metres from 0", depth_noise.min_depth);
  check(depth_noise.max_depth > depth_noise.min_depth, "max_depth", "metres above min_depth",
        depth_noise.max_depth);
  check(good_match_threshold >= 1, "good_match_threshold", "a factor of at least 1", good_match_threshold);
  check(min_good_match >= 4, "min_good_match", "at least 4 matches", min_good_match);
  check(min_inliers >= 4, "min_inliers", "at least 4 inliers", min_inliers);
  const auto is_share = [](double value) { return value >= 0 && value <= 1; };
  check(is_share(min_inlier_share), "min_inlier_share", "a share from 0 to 1", min_inlier_share);
  check(loop_min_inliers >= 4, "loop_min_inliers", "at least 4 inliers", loop_min_inliers);
  check(is_share(loop_min_inlier_share), "loop_min_inlier_share", "a share from 0 to 1",
        loop_min_inlier_share);
  check(positive(max_norm), "max_norm", "rad + m above 0", max_norm);
  check(positive(max_norm_lp), "max_norm_lp", "rad + m above 0", max_norm_lp);
  check(keyframe_threshold >= 0 && keyframe_threshold < max_norm, "keyframe_threshold",
        "rad + m from 0 to max_norm", keyframe_threshold);
  check(weak_tracking >= 0, "weak_tracking", "a number of inliers from 0", weak_tracking);
  check(nearby_loops >= 0, "nearby_loops", "a number of keyframes from 0", nearby_loops);
  check(random_loops >= 0, "random_loops", "a number of keyframes from 0", random_loops);
  check(relocalization_keyframes >= 1, "relocalization_keyframes", "at least 1 keyframe",
        relocalization_keyframes);
}

}  // namespace cairn
