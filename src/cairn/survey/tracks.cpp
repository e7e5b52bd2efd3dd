// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/tracks.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "cairn/geometry/epipolar.h"
#include "cairn/observe/guided_search.h"

namespace cairn {
namespace {

constexpr double kDepthSigmas = 3;  // how far the predicted depth may be wrong

/// Computes how far the pixel in `frame` moves if the disparity that placed the track is kDepthSigmas wrong.
double depth_uncertainty_px(const Rig& rig, const FrameBuffer& frames, const Track& track,
                            const SurveyFrame& frame) {
  const SurveyFrame& then = frames[track.measured.keyframe];
  const Observation& seen = observation_of(frames, track.measured);
  const double nearer = seen.d + kDepthSigmas * seen.sigma_d_px;
  const Rigid3 now_from_then = frame.odometry.inverse() * then.odometry;
  const Eigen::Vector3d there = now_from_then * rig.point_at(seen.u, seen.v, rig.depth(seen.d)),
                        moved = now_from_then * rig.point_at(seen.u, seen.v, rig.depth(nearer));
  if (!is_in_front(there) || !is_in_front(moved)) return std::numeric_limits<double>::infinity();
  return (rig.project(there) - rig.project(moved)).head<2>().norm();
}

/// Returns whether the track is too long to take an observation in `frame`.
bool is_full(const Track& track, KeyframeId frame, const TrackOptions& options) {
  return frame.value - track.observations.front().keyframe.value + 1 >= options.max_frames;
}

/// Returns whether a feature of the frame can show what the track showed last, by the two poses.
bool agrees(const Rig& rig, const FrameBuffer& frames, const Track& track, const SurveyFrame& frame,
            std::size_t feature, double epipolar_px) {
  const Observation& then = observation_of(frames, track.observations.back());
  const Observation& now = frame.observed.observations[feature];
  const Rigid3 now_from_then = frame.odometry.inverse() * frames[track.observations.back().keyframe].odometry;
  const double scale =
      std::max({1.0, static_cast<double>(keypoint_of(frames, track.observations.back()).sigma_px),
                static_cast<double>(frame.observed.features.keypoints[feature].sigma_px)});
  const double off_line = epipolar_distance(rig, now_from_then, {then.u, then.v}, {now.u, now.v});
  if (off_line > epipolar_px * scale) return false;
  const Eigen::Vector3d point = frame.odometry.inverse() * track.point_in_world;
  if (!is_in_front(point)) return false;
  if (!now.has_disparity()) return true;
  const Observation& measured = observation_of(frames, track.measured);
  const double disparity = rig.disparity(point.z()), ratio = disparity / measured.d;
  return std::abs(disparity - now.d) <=
         kDepthSigmas * std::hypot(now.sigma_d_px, ratio * ratio * measured.sigma_d_px) + epipolar_px;
}

}  // namespace

std::vector<TrackMatch> match_to_tracks(const Rig& rig, const FrameBuffer& frames,
                                        std::span<const Track> tracks, const SurveyFrame& frame,
                                        const TrackOptions& options, const Executor& executor) {
  constexpr double kMaxUncertaintyPx = 30;  // more is a point that is passed by
  GuidedSearch search({rig, frame.observed, frame.odometry.inverse()}, options.search_px);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (is_full(tracks[i], frame.id, options)) continue;
    const double uncertainty_px = depth_uncertainty_px(rig, frames, tracks[i], frame);
    if (uncertainty_px <= kMaxUncertaintyPx)
      search.add(i, tracks[i].point_in_world, appearance_of(frames, tracks[i].observations.back()),
                 uncertainty_px);
  }
  std::vector<TrackMatch> matches;
  for (const GuidedMatch& match : search.match(options.max_ratio, executor)) {
    if (agrees(rig, frames, tracks[match.point], frame, static_cast<std::size_t>(match.feature),
               options.epipolar_px))
      matches.push_back({static_cast<std::int32_t>(match.point), match.feature});
  }
  return matches;
}

void drop_unused_features(SurveyFrame& frame, std::span<TrackMatch> matches) {
  const ObservedFrame& observed = frame.observed;
  const std::size_t count = observed.observations.size();
  std::vector<char> useful(count);
  for (std::size_t i = 0; i < count; ++i) useful[i] = observed.observations[i].has_disparity() ? 1 : 0;
  for (const TrackMatch& match : matches) useful[static_cast<std::size_t>(match.feature)] = 1;
  std::vector<std::int32_t> position(count);
  frame.kept.clear();
  for (std::size_t i = 0; i < count; ++i) {
    position[i] = static_cast<std::int32_t>(frame.kept.size());
    if (useful[i] != 0) frame.kept.push_back(static_cast<std::uint32_t>(i));
  }
  for (TrackMatch& match : matches) match.feature = position[static_cast<std::size_t>(match.feature)];
  frame.observed = select(observed, frame.kept);
}

void extend_tracks(const SurveyFrame& frame, std::span<const TrackMatch> matches,
                   std::vector<Track>& tracks) {
  const ObservedFrame& observed = frame.observed;
  const auto point = [&](std::size_t feature) { return frame.odometry * observed.points_in_camera[feature]; };
  std::vector<char> taken(observed.observations.size());
  for (const TrackMatch& match : matches) {
    Track& track = tracks[static_cast<std::size_t>(match.track)];
    const auto feature = static_cast<std::size_t>(match.feature);
    track.observations.push_back({frame.id, match.feature});
    taken[feature] = 1;
    if (!observed.observations[feature].has_disparity()) continue;
    track.measured = track.observations.back();
    track.point_in_world = point(feature);
  }
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i] != 0 || !observed.observations[i].has_disparity()) continue;
    const ObservationRef first{frame.id, static_cast<std::int32_t>(i)};
    tracks.push_back({{first}, first, point(i)});
  }
}

std::vector<Track> extract_finished(KeyframeId newest, const TrackOptions& options,
                                    std::vector<Track>& tracks) {
  const auto is_open = [&](const Track& track) {
    const auto frames_since = [&](const ObservationRef& observation) {
      return newest.value - observation.keyframe.value;
    };
    const bool has_left = frames_since(track.measured) >= options.window;
    return !has_left && !is_full(track, newest, options);
  };
  const auto finished = std::stable_partition(tracks.begin(), tracks.end(), is_open);
  std::vector<Track> taken(std::make_move_iterator(finished), std::make_move_iterator(tracks.end()));
  tracks.erase(finished, tracks.end());
  return taken;
}

}  // namespace cairn
