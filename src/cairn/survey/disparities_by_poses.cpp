// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/disparities_by_poses.h"

#include <algorithm>

#include "cairn/optimize/bundle_adjustment.h"
#include "cairn/sequence/sample_frames.h"
#include "cairn/survey/tracks.h"

namespace cairn {
namespace {

constexpr std::size_t kStretch = 10;  // frames
constexpr std::size_t kFewestFrames = 20, kMostFrames = 60;
constexpr std::size_t kFewestInTrack = 3;  // frames: two agree by chance

/// Returns the first frames, by position among those with a pose, of stretches evenly over a sequence.
std::vector<std::size_t> begins_of_stretches(std::size_t frames) {
  const std::size_t wanted = std::clamp(frames / 10, kFewestFrames, kMostFrames);
  std::vector<std::size_t> begins;
  const std::size_t last = frames > kStretch ? frames - kStretch + 1 : 1;
  for (const FrameId id : sample_frames(last, (wanted + kStretch - 1) / kStretch)) {
    const std::size_t begin = id.index();
    if (begins.empty() || begin >= begins.back() + kStretch) begins.push_back(begin);
  }
  return begins;
}

/// Follows features through one stretch of frames.
class Stretch {
 public:
  Stretch(const Rig& rig, const SurveyOptions& options) : rig_(rig), options_(options) {}

  void add(ObservedFrame&& observed, const GivenPose& given, const Executor& executor) {
    const KeyframeId id{static_cast<std::int32_t>(frames_.size())};
    SurveyFrame frame = make_frame(id, std::move(observed), given, options_.covariance.sigma_px);
    std::vector<TrackMatch> matches;
    if (!frames_.empty()) matches = match_to_tracks(rig_, frames_, tracks_, frame, options_.tracks, executor);
    drop_unused_features(frame, matches);
    frame.landmarks.resize(frame.observed.observations.size());
    extend_tracks(frame, matches, tracks_);
    frames_.push_back(std::move(frame));
  }

  /// Appends the cameras and the tracks that are long enough.
  void append_to(BundleProblem& problem) const {
    const auto first_camera = static_cast<std::int32_t>(problem.camera_from_world.size());
    for (const SurveyFrame& frame : frames_.all()) append_camera(frame, problem);
    for (const Track& track : tracks_) {
      if (track.observations.size() < kFewestInTrack) continue;
      const auto point = static_cast<std::int32_t>(problem.points_in_world.size());
      problem.points_in_world.push_back(track.point_in_world);
      for (const ObservationRef& seen : track.observations)
        problem.observations.push_back(
            {first_camera + seen.keyframe.value, point, observation_of(frames_, seen)});
    }
  }

 private:
  /// Appends a camera: fixed if its given pose states no deviations, else free within these.
  static void append_camera(const SurveyFrame& frame, BundleProblem& problem) {
    const bool is_fixed = !frame.given.uncertainty;
    if (!is_fixed) {
      const Matrix6d covariance = stated_covariance(frame.given) + Matrix6d(least_variances().asDiagonal());
      const Matrix6d information = covariance.inverse();
      problem.priors.push_back({static_cast<std::int32_t>(problem.camera_from_world.size()),
                                frame.camera_from_world, 0.5 * (information + information.transpose())});
    }
    problem.camera_from_world.push_back(frame.camera_from_world);
    problem.camera_fixed.push_back(is_fixed ? 1 : 0);
  }

  const Rig& rig_;
  const SurveyOptions& options_;
  FrameBuffer frames_;
  std::vector<Track> tracks_;
};

/// Returns the positions of the frames that have a pose.
std::vector<std::size_t> frames_with_pose(const GivenPoses& poses) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < poses.frames.size(); ++i)
    if (poses.frames[i]) frames.push_back(i);
  return frames;
}

/// Returns the cameras and tracks of stretches of the sequence.
BundleProblem problem_of_stretches(const Sequence& sequence, const GivenPoses& poses,
                                   const SurveyOptions& options, const Executor& executor) {
  const FrameObserver observer(sequence, options.observer);
  const std::vector<std::size_t> frames = frames_with_pose(poses);
  BundleProblem problem;
  problem.rig = rig_of(sequence.calibration, options.observer.depth_noise);
  for (const std::size_t begin : begins_of_stretches(frames.size())) {
    const std::size_t count = std::min(kStretch, frames.size() - begin);
    auto loaded =
        executor.map<LoadedFrame>(count, [&](std::size_t k) { return observer.load(frames[begin + k]); });
    Stretch stretch(problem.rig, options);
    for (std::size_t k = 0; k < count; ++k)
      if (!loaded[k].failure)
        stretch.add(std::move(loaded[k].observed), *poses.frames[frames[begin + k]], executor);
    stretch.append_to(problem);
  }
  return problem;
}

}  // namespace

DisparityCalibration calibrate_by_poses(const Sequence& sequence, const GivenPoses& poses,
                                        const SurveyOptions& options, const Executor& executor) {
  const std::string& self_calibration = options.observer.stereo_noise.self_calibration;
  DisparityCalibration result;
  if (self_calibration == "off" || !is_stereo(sequence) || frames_with_pose(poses).empty()) return result;
  BundleProblem problem = problem_of_stretches(sequence, poses, options, executor);
  if (problem.observations.empty()) return result;
  const double cost_without = adjusted_cost(problem, executor);
  const FieldReport report = estimate_field(problem, DisparityField::Zero(), executor, result);
  judge_field(problem, cost_without, report.bundle.cost_after, executor, result);
  result.applied = self_calibration == "auto" && result.should_be_applied();
  return result;
}

namespace {

/// Adjusts a problem and leaves out the observations that do not fit, or their disparities alone (Agreement).
void adjust_without_outliers(BundleProblem& problem, const Executor& executor) {
  (void)adjust_bundle(problem, {}, executor);
  std::erase_if(problem.observations, [&](BundleObservation& observation) {
    const Eigen::Vector3d point = problem.camera_from_world[static_cast<std::size_t>(observation.camera)] *
                                  problem.points_in_world[static_cast<std::size_t>(observation.point)];
    const Agreement found = agreement(problem.rig, point, observation.seen);
    if (found == Agreement::pixel) observation.seen = without_disparity(observation.seen);
    return found == Agreement::none;
  });
}

}  // namespace

std::optional<DisparityNoiseEstimate> depth_noise_by_poses(const Sequence& sequence, const GivenPoses& poses,
                                                           const SurveyOptions& options,
                                                           const Executor& executor) {
  const bool is_wanted = !is_stereo(sequence) && options.observer.depth_noise.is_estimated();
  if (!is_wanted || frames_with_pose(poses).empty()) return std::nullopt;
  BundleProblem problem = problem_of_stretches(sequence, poses, options, executor);
  std::optional<DisparityNoiseEstimate> result;
  constexpr int kRounds = 3;  // the first with the cautious weights of the observer
  for (int round = 0; round < kRounds && !problem.observations.empty(); ++round) {
    adjust_without_outliers(problem, executor);
    const auto found = estimate_disparity_noise(problem);
    if (!found) break;
    result = found;
    weigh_disparities(found->noise, problem);
  }
  return result;
}

}  // namespace cairn
