// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/features/extractor.h"

namespace cairn {

/// How noisy depth is. A structured-light or stereo sensor measures disparity, so the standard deviation of a
/// depth z is sigma_disparity_px * z^2 / (fx * baseline): with the defaults 2.3 mm at 1 m and 21 mm at 3 m,
/// twice what Khoshelham and Elberink 2012 measured for the Kinect, as features sit where depth is worst.
struct DepthNoise {
  double baseline = 0.075;           ///< metres, virtual; the Kinect's own
  double sigma_disparity_px = 0.09;  ///< pixels
  double min_depth = 0.2;            ///< metres; nearer is noise
  double jump_radius =
      3.0;  ///< pixels at the lowest pyramid level: depth must be smooth this far around a feature
  double jump_sigmas = 8.0;  ///< standard deviations of disparity: more is a jump
  double max_depth = 8.0;    ///< metres; farther is noise
};

/// RGB-D SLAM. The names of the parameters are those of the files that RGB-D SLAM programs have long read.
struct RgbdSlamOptions {
  FeatureOptions features;
  DepthNoise depth_noise;
  double good_match_threshold = 10;  ///< a match may be this many times worse than the pair's best
  int min_good_match = 20;           ///< matches; fewer cannot be told from chance
  int min_inliers = 20;              ///< matches that agree with one motion; fewer happen by chance
  /// Share of the matches that must be inliers: true motions had more than 0.38 on all recordings tried, at
  /// any speed, chance has less than 0.14.
  double min_inlier_share = 0.15;
  double max_norm = 1.0;            ///< rad + m between neighbours; more is too far: probably wrong
  double max_norm_lp = 5.0;         ///< rad + m, the same for loop closures and after being lost
  double keyframe_threshold = 0.1;  ///< rad + m; less is too close to the last keyframe
  int weak_tracking = 80;           ///< inliers; with fewer a keyframe is made before the view is lost
  /// A loop closure, and a pose after being lost, must rest on more: they have no neighbour to contradict
  /// them. Wrong ones were seen with up to 23 inliers, a tenth of the matches.
  int loop_min_inliers = 30;
  double loop_min_inlier_share = 0.2;
  bool check_loop_closure = true;
  int nearby_loops = 5;               ///< the last so many keyframes are tried
  int random_loops = 5;               ///< and so many of all others
  int relocalization_keyframes = 20;  ///< recent keyframes tried when lost
  bool odometry = false;              ///< stop after tracking: no loops, no graph
  std::uint64_t seed = 1;

  /// InputError naming the parameter that is out of range.
  void validate() const;
};

}  // namespace cairn
