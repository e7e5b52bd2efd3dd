// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/options.h"

#include "cairn/core/parameter.h"

namespace cairn {
namespace {

void visit(TrackingOptions& tracking, ParameterVisitor& visitor) {
  visitor.parameter({"tracking.motion_radius_px", above(0, "pixels"),
                     "Search radius around the position that the last motion predicts for a landmark, at the "
                     "finest scale."},
                    tracking.motion_radius_px);
  visitor.parameter({"tracking.map_radius_px", above(0, "pixels"),
                     "Search radius around the position of a landmark once the pose is known to some pixels, "
                     "at the finest scale."},
                    tracking.map_radius_px);
  visitor.parameter({"tracking.local_keyframes", at_least(1, "keyframe"),
                     "Keyframes that share most landmarks with the frame, whose landmarks are looked for."},
                    tracking.local_keyframes);
  visitor.parameter({"tracking.local_neighbours", from(0, "a number of keyframes"),
                     "Neighbours of each of these keyframes, whose landmarks are looked for as well."},
                    tracking.local_neighbours);
}

void visit(MappingOptions& mapping, ParameterVisitor& visitor) {
  visitor.parameter(
      {"mapping.view_change", from(0, "radians"),
       "Change of the view that makes a keyframe due: rotation, plus the distance moved divided "
       "by the median depth."},
      mapping.view_change);
  visitor.parameter({"mapping.trial_keyframes", at_least(1, "keyframe"),
                     "A new landmark must be seen again within this number of keyframes, or it is dropped."},
                    mapping.trial_keyframes);
  visitor.retired({"mapping.triangulate", "no", "it improved the result on none of the recordings tried"});
  visitor.parameter({"mapping.window_keyframes", at_least(1, "keyframe"),
                     "Keyframes that are adjusted together after each new one."},
                    mapping.window_keyframes);
  visitor.parameter({"mapping.window_fixed", from(0, "a number of keyframes"),
                     "Further keyframes that see the same landmarks and hold them in place."},
                    mapping.window_fixed);
  visitor.parameter({"mapping.window_lag", from(0, "a number of frames"),
                     "Frames after which an adjustment, which runs beside tracking, is applied."},
                    mapping.window_lag);
  visitor.parameter({"mapping.redundant_share", above_up_to(0, 1, "a share"),
                     "A keyframe is erased if three others see this share of its landmarks."},
                    mapping.redundant_share);
}

void visit_matching(SlamOptions& slam, ParameterVisitor& visitor) {
  visitor.parameter({"max_distance_factor", from(1, "a factor"),
                     "Largest distance of a match's descriptors, relative to the best match of both images.",
                     "good_match_threshold"},
                    slam.max_distance_factor);
  visitor.parameter({"min_matches", at_least(4, "matches"),
                     "Fewest matches from which a motion is estimated: fewer cannot be told from chance.",
                     "min_good_match"},
                    slam.min_matches);
  visitor.parameter(
      {"min_inliers", at_least(4, "inliers"), "Fewest matches that must agree with one motion."},
      slam.min_inliers);
  visitor.parameter({"min_inlier_share", from_to(0, 1, "a share"),
                     "Smallest share of the matches that must agree with one motion."},
                    slam.min_inlier_share);
}

void visit_motion(SlamOptions& slam, ParameterVisitor& visitor) {
  visitor.parameter(
      {"max_motion", above(0, "rad + m"),
       "Motion between neighbouring frames that is too large to be believed: a pose this far or farther from "
       "the last one known is refused, however it was found. If frames are missing or were refused, as many "
       "times more. Components of the map are joined under the same limit.",
       "max_norm"},
      slam.max_motion);
  visitor.parameter({"max_loop_motion", above(0, "rad + m"),
                     "The same limit from the keyframe with which a loop closes, or by which a frame is "
                     "recognised after tracking was lost.",
                     "max_norm_lp"},
                    slam.max_loop_motion);
  visitor.parameter({"keyframe_threshold", from(0, "rad + m"),
                     "A frame with less motion since the last keyframe makes no keyframe."},
                    slam.keyframe_threshold);
  visitor.parameter(
      {"weak_inliers", from(0, "a number of inliers"),
       "A frame with fewer inliers makes a keyframe, before tracking is lost.", "weak_tracking"},
      slam.weak_inliers);
}

void visit_loops(SlamOptions& slam, ParameterVisitor& visitor) {
  visitor.parameter({"close_loops", {}, "Whether loops are looked for.", "check_loop_closure"},
                    slam.close_loops);
  visitor.parameter({"place_loops", from(0, "a number of keyframes"),
                     "Keyframes tried as a loop with each new one: those that look most like it."},
                    slam.place_loops);
  visitor.parameter({"nearby_loops", from(0, "a number of keyframes"), "The last keyframes, tried as well."},
                    slam.nearby_loops);
  visitor.parameter({"random_loops", from(0, "a number of keyframes"),
                     "Keyframes chosen at random from all others, tried as well."},
                    slam.random_loops);
  visitor.parameter({"loop_min_inliers", at_least(4, "inliers"),
                     "Fewest inliers of a loop, and of a pose after tracking was lost."},
                    slam.loop_min_inliers);
  visitor.parameter(
      {"loop_min_inlier_share", from_to(0, 1, "a share"),
       "Smallest share of inliers among the matches of a loop, and of a pose after tracking was "
       "lost."},
      slam.loop_min_inlier_share);
  visitor.parameter({"relocalization_keyframes", at_least(1, "keyframe"),
                     "Recent keyframes in which a frame is looked for after tracking was lost."},
                    slam.relocalization_keyframes);
  visitor.parameter(
      {"lost_frames", at_least(1, "frame"),
       "Good images that fit nowhere, after which a second component of the map begins.", "max_num_lost"},
      slam.lost_frames);
}

/// Those of the RGB-D tutorial and of slambook's visual odometry that cairn has no use for.
void visit_foreign(ParameterVisitor& visitor) {
  constexpr const char* kAny = "";
  visitor.retired({"visualize_pointcloud", kAny, "clouds are written, not shown"});
  visitor.retired({"dataset_dir", kAny, "the sequence is named on the command line"});
  visitor.retired({"scale_factor", kAny, "the pyramid of the features has a fixed step"});
  visitor.retired({"level_pyramid", kAny, "the pyramid of the features has a fixed number of levels"});
  visitor.retired(
      {"match_ratio", kAny, "it goes with a least distance of 30; max_distance_factor is the limit here"});
  visitor.retired({"keyframe_rotation", kAny, "keyframe_threshold limits the sum of rotation and motion"});
  visitor.retired({"keyframe_translation", kAny, "keyframe_threshold limits the sum of rotation and motion"});
  visitor.retired({"map_point_erase_ratio", kAny, "landmarks are kept by who sees them again"});
}

}  // namespace

void visit(SlamOptions& options, ParameterVisitor& visitor) {
  visit(options.observer, visitor);
  visit_matching(options, visitor);
  visit_motion(options, visitor);
  visit_loops(options, visitor);
  visit_foreign(visitor);
  visit(options.tracking, visitor);
  visit(options.mapping, visitor);
}

void SlamOptions::validate() const {
  observer.validate();
  check_ranges(*this);
  const Range period = from(0, "seconds");
  check_parameter(period.contains(frame_period_s), "frame_period_s", period.describe().c_str(),
                  frame_period_s);
}

}  // namespace cairn
