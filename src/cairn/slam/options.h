// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/parameter.h"
#include "cairn/observe/observer.h"

namespace cairn {

/// Holds the options of tracking, that is, of the search for landmarks in a frame.
struct TrackingOptions {
  /// Search radius around the pixel that the last motion predicts, at the finest scale.
  double motion_radius_px = 15;
  double map_radius_px = 4;  ///< search radius once the pose is known to some pixels, at the finest scale
  /// Keyframes with the most landmarks in common with the frame, whose landmarks are searched for as well.
  int local_keyframes = 10;
  int local_neighbours = 5;  ///< neighbours of each local keyframe, whose landmarks are searched for as well
};

/// Holds the options of mapping, that is, of extending and adjusting the map.
struct MappingOptions {
  /// Change of the view that makes a keyframe due: rotation in radians, plus translation over the median
  /// depth.
  double view_change = 0.05;
  int trial_keyframes = 3;    ///< a new landmark must be seen again within this number of keyframes
  int window_keyframes = 12;  ///< keyframes that are adjusted together after each new one
  int window_fixed = 20;      ///< further keyframes that show the same landmarks and are held fixed
  /// Frames after which an adjustment, which runs beside tracking, is applied.
  int window_lag = 3;
  /// A keyframe is erased if three others see more than this share of its landmarks.
  double redundant_share = 0.9;
};

/// Holds the options of SLAM with an RGB-D or stereo camera. Files may also use the names of older
/// parameters, those that RGB-D SLAM programs have long read (`former_name` in `visit`).
struct SlamOptions {
  /// Options of observing frames; 1500 features, to have enough in views that show little.
  ObserverOptions observer{.features = {.detector = "ORB", .descriptor = "ORB", .count = 1500},
                           .depth_noise = {},
                           .stereo_noise = {}};
  TrackingOptions tracking;
  MappingOptions mapping;
  /// Largest distance of a match, in multiples of the best match of the two frames.
  double max_distance_factor = 10;
  int min_matches = 20;  ///< fewest matches; fewer cannot be told from chance
  int min_inliers = 20;  ///< fewest matches that agree with one motion; fewer happen by chance
  /// Smallest share of inliers among the matches: true motions had more than 0.38 on all recordings tried, at
  /// any speed; chance has less than 0.14.
  double min_inlier_share = 0.15;
  /// Largest motion between neighbouring frames, rad + m; a pose farther away is probably wrong, and is
  /// refused however it was found. If frames are missing or were refused, as many times more.
  double max_motion = 10.0;
  /// Time between neighbouring frames that max_motion is for, seconds; 0: run_slam takes the sequence's
  /// median.
  double frame_period_s = 0;
  /// Largest motion from the keyframe with which a loop closes, or by which a frame is found after tracking
  /// was lost, rad + m.
  double max_loop_motion = 20.0;
  double keyframe_threshold = 0.1;  ///< rad + m; with less motion since the last keyframe none is made
  int weak_inliers = 80;            ///< inliers; with fewer a keyframe is made, before tracking is lost
  /// Fewest inliers of a loop closure and of a pose after tracking was lost, which have no neighbour to
  /// contradict them. Wrong ones were seen with up to 23 inliers, a tenth of the matches.
  int loop_min_inliers = 30;
  /// Smallest share of inliers among the matches of a loop closure and of a pose after tracking was lost.
  double loop_min_inlier_share = 0.2;
  bool close_loops = true;
  int place_loops = 3;   ///< keyframes tried as a loop with each new one: those that look most like it
  int nearby_loops = 0;  ///< last keyframes tried as a loop
  int random_loops = 0;  ///< keyframes tried as a loop, drawn from all others
  int relocalization_keyframes = 20;  ///< recent keyframes tried after tracking was lost
  /// Frames with enough depth that cannot be tracked, after which a second component of the map begins.
  int lost_frames = 8;
  bool odometry = false;  ///< odometry only: no loops, and no adjustment of the whole map at the end
  std::uint64_t seed = 1;

  /// Throws InputError naming the parameter that is out of range.
  void validate() const;
};

/// Visits the parameters of SLAM, in the order of config.yaml, with those of the observer.
void visit(SlamOptions& options, ParameterVisitor& visitor);

}  // namespace cairn
