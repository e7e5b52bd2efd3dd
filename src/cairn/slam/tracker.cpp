// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/tracker.h"

#include <algorithm>
#include <cmath>

#include "cairn/slam/local_map.h"
#include "cairn/slam/relocalizer.h"

namespace cairn {
namespace {

constexpr double kWeakShare = 0.25;  // of the motion that else makes a keyframe

/// Returns the points in the world that a frame's features show: those of landmarks, else those by depth.
std::vector<Eigen::Vector3d> points_shown(const Map& map, const ObservedFrame& observed,
                                          const FramePose& tracked) {
  std::vector<Eigen::Vector3d> points(observed.observations.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LandmarkId id = tracked.landmarks[i];
    const bool alive = id.valid() && !map[id].erased();
    points[i] = alive ? map[id].point_in_world : tracked.world_from_camera * observed.points_in_camera[i];
  }
  return points;
}

}  // namespace

Tracker::Tracker(const SlamOptions& options, const Executor& executor, const IndexedMap& indexed)
    : options_(options), executor_(executor), indexed_(indexed), map_(indexed.map()) {}

/// Searches the frame for the landmarks and other points that the last frame shows.
std::vector<Correspondence> Tracker::find_shown_before(const PosedFrame& frame, double radius_px) const {
  GuidedSearch search(frame, radius_px);
  const auto points = points_shown(map_, observed_, last_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    search.add(i, points[i],
               {&observed_.features.descriptors, i, observed_.features.keypoints[i],
                last_.world_from_camera.translation});
  }
  std::vector<Correspondence> found;
  for (const GuidedMatch& match : search.match()) {
    const LandmarkId id = last_.landmarks[match.point];
    const bool alive = id.valid() && !map_[id].erased();
    found.push_back({match.feature, alive ? id : LandmarkId{}, points[match.point]});
  }
  return found;
}

/// Solves for the pose near the one that `frame` has, by what the last frame shows. Half of what is found
/// must agree: in windows of this size chance alone agrees with one in forty.
std::optional<FramePose> Tracker::follow_from(const PosedFrame& frame, double radius_px) const {
  const auto found = find_shown_before(frame, radius_px);
  FramePose current;
  const bool is_solved = static_cast<int>(found.size()) >= options_.min_matches &&
                         solve_pose(frame, found, options_.min_inliers, current);
  if (!is_solved || 2 * current.inliers < current.matches) return std::nullopt;
  return current;
}

std::optional<FramePose> Tracker::follow_motion(const ObservedFrame& frame) const {
  const Rigid3 predicted = current_from_last_ * last_.world_from_camera.inverse();
  for (const double widening : {1.0, 3.0}) {
    auto current = follow_from({map_.rig(), frame, predicted}, widening * options_.tracking.motion_radius_px);
    if (current) return current;
  }
  return std::nullopt;
}

std::optional<FramePose> Tracker::match_last(const ObservedFrame& frame, TrackingResult& track) const {
  const Rigid3 last_from_world = last_.world_from_camera.inverse();
  std::vector<Eigen::Vector3d> points = points_shown(map_, observed_, last_);
  for (Eigen::Vector3d& point : points) point = last_from_world * point;
  const Motion motion = estimate_motion(map_.rig(), {observed_, points}, frame, options_);
  track.status =
      tracking_status(motion, options_, steps_between(observed_.stamp_ns, frame.stamp_ns, options_));
  track.matches = motion.matches;
  track.inliers = motion.inliers;
  if (track.status == TrackingStatus::implausible) return std::nullopt;
  if (!motion.found) {  // few descriptors are alike after a wide step: with a guess more are found
    if (!motion.is_guess) return std::nullopt;
    auto current = follow_from({map_.rig(), frame, motion.current_from_reference * last_from_world},
                               options_.tracking.motion_radius_px);
    return current && current->is_determined ? current : std::nullopt;
  }
  FramePose current;
  current.world_from_camera = last_.world_from_camera * motion.current_from_reference.inverse();
  current.landmarks.resize(frame.observations.size());
  for (const Match& pair : motion.pairs) {
    const LandmarkId id = last_.landmarks[static_cast<std::size_t>(pair.train)];
    if (id.valid() && !map_[id].erased()) current.landmarks[static_cast<std::size_t>(pair.query)] = id;
  }
  current.matches = motion.matches;
  current.inliers = motion.inliers;
  return current;
}

/// Finds the pose by the predicted motion. Also matches without it if that finds much less than the last
/// frame showed, or if no motion is known: points far away agree with nearly any motion, and so with a wrong
/// one.
std::optional<FramePose> Tracker::follow(const ObservedFrame& frame, TrackingResult& track) const {
  std::optional<FramePose> current = follow_motion(frame);
  if (current && motion_known_ && 2 * current->inliers >= last_.inliers) return current;
  std::optional<FramePose> matched = match_last(frame, track);
  if (matched && (!current || matched->inliers > current->inliers)) return matched;
  return current;
}

/// Returns false, with the reason in `track`, if the camera cannot have come to the pose.
bool Tracker::admit(const ObservedFrame& frame, const FramePose& current, KeyframeId reference,
                    TrackingResult& track) const {
  if (known_.allow(map_, reference, current.world_from_camera, frame.stamp_ns, options_)) return true;
  track.status = TrackingStatus::implausible;
  track.matches = current.matches;
  track.inliers = current.inliers;
  return false;
}

std::optional<FramePose> Tracker::find_again(const ObservedFrame& frame, TrackingResult& track) {
  auto found = relocalize(indexed_, frame, options_, executor_);
  if (!found || !admit(frame, found->tracked, found->keyframe, track)) return std::nullopt;
  track.relocalized = lost_;
  reference_ = found->keyframe;
  return std::move(found->tracked);
}

bool Tracker::is_keyframe_due(const ObservedFrame& frame, const FramePose& current) const {
  const Rigid3 motion = map_.world_from_camera(reference_).inverse() * current.world_from_camera;
  const bool is_weak = current.inliers < options_.weak_inliers;
  // a view that is poor is soon lost; but a camera at rest needs no keyframes, however poor the view
  if (is_weak && motion_norm(motion) > kWeakShare * options_.keyframe_threshold) return true;
  if (motion_norm(motion) <= options_.keyframe_threshold) return false;
  const double depth = median_depth(frame);
  const double view_change = rotation_angle(motion.rotation) + motion.translation.norm() / depth;
  return !(view_change <= options_.mapping.view_change);  // without a depth, too
}

/// Makes the keyframe that shows most of what the frame shows the reference.
void Tracker::refer_to_best(const FramePose& current) {
  const auto views = keyframes_showing(map_, current.landmarks);
  if (!views.empty()) reference_ = views.front().keyframe;
}

void Tracker::accept(ObservedFrame&& frame, FramePose&& current, TrackingResult& track) {
  current_from_last_ = lost_ ? Rigid3{} : current.world_from_camera.inverse() * last_.world_from_camera;
  motion_known_ = !lost_;
  refer_to_best(current);
  track.status = is_keyframe_due(frame, current) ? TrackingStatus::keyframe : TrackingStatus::tracked;
  track.matches = current.matches;
  track.inliers = current.inliers;
  track.reference = reference_;
  reference_from_last_ = map_.world_from_camera(reference_).inverse() * current.world_from_camera;
  track.reference_from_frame = reference_from_last_;
  known_.remember(map_, reference_, reference_from_last_, frame.stamp_ns);
  observed_ = std::move(frame);
  last_ = std::move(current);
}

TrackingResult Tracker::track(ObservedFrame&& frame) {
  TrackingResult track{frame.frame, frame.stamp_ns, {}, false, std::nullopt, {}, 0, 0};
  std::optional<FramePose> current;
  if (!lost_) {
    current = follow(frame, track);
    if (current) (void)refine_in_map(map_, frame, options_, *current);
    if (current && !admit(frame, *current, reference_, track)) current.reset();
  }
  if (!current) {
    lost_ = true;
    if (!map_.keyframes().empty()) current = find_again(frame, track);
  }
  if (current) {
    accept(std::move(frame), std::move(*current), track);
  } else {
    observed_ = std::move(frame);
  }
  lost_ = !current.has_value();
  return track;
}

void Tracker::refer_to(KeyframeId keyframe) {
  reference_ = keyframe;
  if (lost_) {
    motion_known_ = false;
    current_from_last_ = {};
  }
  lost_ = false;
  reference_from_last_ = {};
  known_.remember(map_, keyframe, {}, observed_.stamp_ns);
  follow_map();
}

void Tracker::follow_map() {
  if (lost_) return;
  last_.world_from_camera = map_.world_from_camera(reference_) * reference_from_last_;
  if (observed_.frame != map_[reference_].observed.frame) return;
  last_.landmarks = map_[reference_].landmarks;
}

}  // namespace cairn
