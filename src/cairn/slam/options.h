// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/parameter.h"
#include "cairn/observe/observer.h"

namespace cairn {

/// Looking for what the map holds in the next frame.
struct TrackingOptions {
  double motion_radius_px = 15;  ///< around where the last motion would show a point, at the lowest level
  double map_radius_px = 4;      ///< the same once the pose is known to some pixels
  int local_keyframes = 10;      ///< that show most of what the frame shows
  int local_neighbours = 5;      ///< of each, that share most landmarks with it
};

/// Keeping the map right while it grows.
struct MappingOptions {
  /// Radians, plus the way over the median depth: a keyframe is due when the view has changed by as much.
  double view_change = 0.05;
  int trial_keyframes = 3;    ///< a landmark must be seen again within so many, or it is given up
  int window_keyframes = 12;  ///< that are adjusted together after each new one
  int window_fixed = 20;      ///< others that see the same landmarks and hold them in place
  int window_lag = 3;         ///< frames: the adjustment runs beside tracking and is taken over after so many
  double redundant_share = 0.9;  ///< of a keyframe's landmarks seen by three others: it is erased
};

/// Holds the options of SLAM with an RGB-D or stereo camera. Files may also use the names of older
/// parameters, those that RGB-D SLAM programs have long read (`former_name` in `visit`).
struct SlamOptions {
  /// 1500 features: room for the views that show little.
  ObserverOptions observer{.features = {.detector = "ORB", .descriptor = "ORB", .count = 1500},
                           .depth_noise = {},
                           .stereo_noise = {}};
  TrackingOptions tracking;
  MappingOptions mapping;
  double max_distance_factor = 10;  ///< a match may be this many times worse than the pair's best
  int min_matches = 20;             ///< matches; fewer cannot be told from chance
  int min_inliers = 20;             ///< matches that agree with one motion; fewer happen by chance
  /// Share of the matches that must be inliers: true motions had more than 0.38 on all recordings tried, at
  /// any speed, chance has less than 0.14.
  double min_inlier_share = 0.15;
  /// rad + m between neighbours; a pose that is farther is too far, probably wrong, and refused wherever it
  /// comes from. Per frame period: where frames are missing or were refused, so many times more.
  double max_motion = 10.0;
  /// Seconds between neighbours, which max_motion is for; 0: run_slam takes the sequence's median.
  double frame_period_s = 0;
  /// rad + m from the keyframe that a loop closes with, or that a frame is recognised by after being lost.
  double max_loop_motion = 20.0;
  double keyframe_threshold = 0.1;  ///< rad + m; less is too close to the last keyframe
  int weak_inliers = 80;            ///< inliers; with fewer a keyframe is made before the view is lost
  /// A loop closure, and a pose after being lost, must rest on more: they have no neighbour to contradict
  /// them. Wrong ones were seen with up to 23 inliers, a tenth of the matches.
  int loop_min_inliers = 30;
  double loop_min_inlier_share = 0.2;
  bool close_loops = true;
  int place_loops = 3;                ///< keyframes that look most like the new one are tried
  int nearby_loops = 0;               ///< so are the last so many keyframes
  int random_loops = 0;               ///< and so many of all others
  int relocalization_keyframes = 20;  ///< recent keyframes tried when lost
  int lost_frames = 8;  ///< good images that fit nowhere: after so many a second component of the map begins
  bool odometry = false;  ///< no loops, and no adjustment of the whole at the end
  std::uint64_t seed = 1;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of SLAM, in the order of config.yaml, with those of the observer.
void visit(SlamOptions& options, ParameterVisitor& visitor);

}  // namespace cairn
