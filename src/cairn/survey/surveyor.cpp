// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/surveyor.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/stopwatch.h"
#include "cairn/survey/duplicates.h"
#include "cairn/survey/held_out.h"
#include "cairn/survey/pose_adjustment.h"

namespace cairn {
namespace {

/// Returns what is stored of a landmark; `stated` says whether given poses state deviations.
FinishedLandmark finished(const FrameBuffer& frames, const SurveyLandmark& landmark, bool stated) {
  FinishedLandmark result;
  result.point_in_world = landmark.point_in_world;
  result.covariance = landmark.covariance();
  if (stated) result.noise_covariance = landmark.image_covariance;
  result.observations = landmark.observations;
  result.indicators = landmark.indicators;
  std::vector<Appearance> appearances;
  for (const ObservationRef& observation : landmark.observations) {
    appearances.push_back(appearance_of(frames, observation));
    result.keypoints.push_back(appearances.back().keypoint);
  }
  result.descriptors = gather(appearances);
  return result;
}

std::int64_t count_measured(const ObservedFrame& observed) {
  return std::count_if(observed.observations.begin(), observed.observations.end(),
                       [](const Observation& seen) { return seen.has_disparity(); });
}

/// Counts the observations that lie far from where the landmark is projected to.
void count_residuals(const Rig& rig, const FrameBuffer& frames, const SurveyLandmark& landmark,
                     SurveyCounts& counts) {
  for (const ObservationRef& observation : landmark.observations) {
    const Observation& seen = observation_of(frames, observation);
    const Eigen::Vector3d point = frames[observation.keyframe].camera_from_world * landmark.point_in_world;
    const double off = (rig.project(point).head<2>() - Eigen::Vector2d(seen.u, seen.v)).norm();
    for (std::size_t i = 0; i < kBeyondPx.size(); ++i) counts.beyond[i] += off > kBeyondPx[i] ? 1 : 0;
  }
}

void count_uncertainty(const SurveyLandmark& landmark, SurveyCounts& counts) {
  const double by_images = largest_std(landmark.image_covariance),
               by_poses = largest_std(landmark.pose_covariance);
  counts.image_variance_m2 += by_images * by_images;
  counts.pose_variance_m2 += by_poses * by_poses;
  counts.dominated_by_poses += by_poses > by_images ? 1 : 0;
}

}  // namespace

Surveyor::Surveyor(const Rig& rig, const SurveyOptions& options, SurveyState&& state, MapWriter& writer)
    : rig_(rig), options_(options), state_(std::move(state)), writer_(writer) {}

void Surveyor::add(const ObservedFrame& observed, const GivenPose& given, const Executor& executor) {
  if (is_stationary(observed, given)) {
    ++state_.counts.stationary;
    return;
  }
  Stopwatch watch;
  SurveyFrame frame = make_frame(state_.next_frame, observed, given, options_.covariance.sigma_px);
  auto matches = find_tracks(frame, executor);
  drop_unused_features(frame, matches);
  frame.landmarks.resize(frame.observed.observations.size());
  extend_tracks(frame, matches, state_.tracks);
  const KeyframeId id = frame.id;
  state_.frames.push_back(std::move(frame));
  ++state_.next_frame.value;
  ++state_.counts.frames;
  state_.counts.features += static_cast<std::int64_t>(observed.observations.size());
  state_.counts.measured += count_measured(observed);
  state_.counts.matched += static_cast<std::int64_t>(matches.size());
  times_.matching += watch.lap();
  finish_tracks(id);
  const int reach = options_.tracks.pose_frames;
  if (id.value + 1 < state_.first_open_pose.value + 2 * reach) return;
  settle_poses({id.value + 1 - reach}, executor);
  adjust_settled_tracks(executor);
  // What a landmark may be merged with has left the window at most one window later.
  const int settled = state_.first_open_pose.value, window = options_.tracks.window;
  write_landmarks({settled - 2 * window});
  write_frames(std::min(first_open_frame(), {settled - std::max(window, reach)}));
}

void Surveyor::finish(const Executor& executor) {
  finish_tracks({state_.next_frame.value + options_.tracks.window});
  settle_poses(state_.next_frame, executor);
  adjust_settled_tracks(executor);
  write_landmarks(state_.next_frame);
  write_frames(state_.next_frame);
}

/// Matches the frame with the tracks: by the given poses, and again by the measured motion if the images show
/// one.
std::vector<TrackMatch> Surveyor::find_tracks(SurveyFrame& frame, const Executor& executor) const {
  const auto match = [&] {
    return match_to_tracks(rig_, state_.frames, state_.tracks, frame, options_.tracks, executor);
  };
  if (state_.frames.empty()) return {};
  const SurveyFrame& previous = state_.frames.back();
  frame.odometry = WorldFromCamera(
      previous.odometry * Rigid3(previous.given.world_from_camera.inverse() * frame.given.world_from_camera));
  auto matches = match();
  if (options_.tracks.pose_frames == 0) return matches;
  frame.motion = measure_motion(rig_, state_.frames, state_.tracks, frame, matches);
  if (!frame.motion) return matches;
  frame.odometry = WorldFromCamera(previous.odometry * frame.motion->previous_from_this);
  return match();
}

bool Surveyor::is_stationary(const ObservedFrame& observed, const GivenPose& given) const {
  if (state_.frames.empty()) return false;
  const Rigid3 moved = state_.frames.back().camera_from_world * given.world_from_camera;
  const double depth = median_depth(observed);
  const double way = moved.translation.norm();
  return rotation_angle(moved.rotation) + (depth > 0 ? way / depth : way) < options_.tracks.min_view_change;
}

void Surveyor::finish_tracks(KeyframeId newest) {
  auto finished = extract_finished(newest, options_.tracks, state_.tracks);
  state_.counts.tracks += static_cast<std::int64_t>(finished.size());
  std::move(finished.begin(), finished.end(), std::back_inserter(state_.finished));
}

/// Gives the frames before `first_open` their final poses.
void Surveyor::settle_poses(KeyframeId first_open, const Executor& executor) {
  Stopwatch watch;
  std::vector<const Track*> tracks;
  for (const auto* some : {&state_.finished, &state_.tracks})
    for (const Track& track : *some) tracks.push_back(&track);
  if (options_.tracks.pose_frames > 0)
    adjust_poses(rig_, tracks, state_.first_open_pose, options_.tracks.pose_frames, executor, state_.frames);
  for (; state_.first_open_pose < first_open; ++state_.first_open_pose.value)
    count_moved(state_.first_open_pose);
  times_.poses += watch.lap();
}

void Surveyor::count_moved(KeyframeId id) {
  const SurveyFrame& frame = state_.frames[id];
  const Rigid3 moved = frame.given.world_from_camera.inverse() * frame.world_from_camera;
  const double angle = rotation_angle(moved.rotation);
  state_.counts.moved_squared_m += moved.translation.squaredNorm();
  state_.counts.turned_squared_rad += angle * angle;
  if (frame.given.uncertainty) state_.moves.push_back(move_in_sigmas(frame.given, frame.world_from_camera));
}

/// Makes landmarks of the finished tracks whose frames have their final poses.
void Surveyor::adjust_settled_tracks(const Executor& executor) {
  Stopwatch watch;
  const auto settled = std::stable_partition(
      state_.finished.begin(), state_.finished.end(),
      [&](const Track& track) { return track.observations.back().keyframe >= state_.first_open_pose; });
  const std::span<const Track> tracks(settled, state_.finished.end());
  AdjustedTracks adjusted = adjust_tracks(rig_, state_.frames, tracks, options_, executor);
  state_.finished.erase(settled, state_.finished.end());
  SurveyCounts& counts = state_.counts;
  counts.too_short += adjusted.too_short;
  counts.inconsistent += adjusted.inconsistent;
  counts.dropped_observations += adjusted.dropped_observations;
  for (const SurveyLandmark& landmark : adjusted.landmarks)
    state_.variance.add(landmark.squared_error_sum, landmark.redundancy);
  std::vector<SurveyLandmark> cleaned = clean(std::move(adjusted.landmarks));
  times_.adjustment += watch.lap();
  const VariancePrior prior = state_.variance.prior();
  counts.merged +=
      merge_duplicates({rig_, state_.frames, prior, options_}, std::move(cleaned), state_.pending);
  times_.merging += watch.lap();
}

std::vector<SurveyLandmark> Surveyor::clean(std::vector<SurveyLandmark>&& landmarks) {
  const VariancePrior prior = state_.variance.prior();
  std::vector<SurveyLandmark> kept;
  for (SurveyLandmark& landmark : landmarks) {
    landmark.variance_factor = prior.factor(landmark.squared_error_sum, landmark.redundancy);
    const auto rule = failed_rule(landmark.indicators, landmark.own_covariance(), options_.cleaning);
    if (rule) {
      ++state_.counts.cleaned[static_cast<std::size_t>(*rule)];
      continue;
    }
    state_.noise.add(landmark.information.errors);
    kept.push_back(std::move(landmark));
  }
  return kept;
}

/// Writes the landmarks whose last observation is in a frame before `seen_before`.
void Surveyor::write_landmarks(KeyframeId seen_before) {
  Stopwatch watch;
  std::vector<SurveyLandmark> later;
  const NoisePrior prior{state_.variance.prior(), state_.noise.noise()};
  HoldOut hold_out(rig_, options_, prior, state_.frames);
  const bool stated = options_.covariance.pose_errors && !state_.frames.empty() &&
                      state_.frames.front().given.uncertainty.has_value();
  for (SurveyLandmark& landmark : state_.pending) {
    if (landmark.observations.back().keyframe >= seen_before) {
      later.push_back(std::move(landmark));
      continue;
    }
    complete_covariance(state_.frames, prior, options_.covariance.pose_errors, landmark);
    hold_out.add(landmark);
    write_landmark(landmark, stated);
  }
  state_.pending = std::move(later);
  times_.writing += watch.lap();
}

void Surveyor::write_landmark(const SurveyLandmark& landmark, bool stated) {
  for (const ObservationRef& observation : landmark.observations)
    state_.frames[observation.keyframe].landmarks[static_cast<std::size_t>(observation.feature)] =
        state_.next_landmark;
  writer_.add_landmark(finished(state_.frames, landmark, stated));
  ++state_.next_landmark.value;
  ++state_.counts.landmarks;
  state_.counts.observations += static_cast<std::int64_t>(landmark.observations.size());
  count_residuals(rig_, state_.frames, landmark, state_.counts);
  count_uncertainty(landmark, state_.counts);
}

/// Writes the frames before `before`, whose landmarks must all be known.
void Surveyor::write_frames(KeyframeId before) {
  Stopwatch watch;
  for (; !state_.frames.empty() && state_.frames.front().id < before; state_.frames.pop_front()) {
    if (const auto found = locate_held_out(rig_, state_.frames.front(), options_.covariance.sigma_px))
      state_.held_out.push_back(*found);
    writer_.add_frame(state_.frames.front().observed, state_.frames.front().landmarks,
                      state_.frames.front().world_from_camera);
  }
  times_.writing += watch.lap();
}

/// Returns the first frame that is seen by a track or by a landmark that was not written yet.
KeyframeId Surveyor::first_open_frame() const {
  KeyframeId first = state_.next_frame;
  for (const auto* tracks : {&state_.finished, &state_.tracks})
    for (const Track& track : *tracks) first = std::min(first, track.observations.front().keyframe);
  for (const SurveyLandmark& landmark : state_.pending)
    first = std::min(first, landmark.observations.front().keyframe);
  return first;
}

}  // namespace cairn
