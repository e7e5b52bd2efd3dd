// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/slam.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/observe/observe_frames.h"
#include "cairn/slam/depth_noise_estimator.h"
#include "cairn/slam/final_poses.h"
#include "cairn/slam/mapper.h"
#include "cairn/slam/mapping.h"

namespace cairn {
namespace {

void require_depth(const Sequence& sequence) {
  if (sequence.frames.empty()) return;
  const FrameFiles& first = sequence.frames.front();
  if (!first.depth.empty() || !first.right.empty()) return;
  throw InputError({sequence.folder.string(), 0, "an RGB-D or stereo sequence",
                    fmt::format("a {} sequence without depth or right images", sequence.format),
                    "Without either there is no scale; record with an RGB-D or a stereo camera."});
}

void require_same(const Map& start, const Rig& rig, const SlamOptions& options) {
  const Rig& other = start.rig();
  if (!are_same(other, rig))
    throw InputError({"the map", 0,
                      fmt::format("the camera fx {} fy {} cx {} cy {} baseline {}", rig.fx, rig.fy, rig.cx,
                                  rig.cy, rig.baseline),
                      fmt::format("fx {} fy {} cx {} cy {} baseline {}", other.fx, other.fy, other.cx,
                                  other.cy, other.baseline),
                      "A map goes on with the camera that it was made with."});
  if (start.descriptor() != options.observer.features.descriptor)
    throw InputError({"the map", 0, fmt::format("descriptors {}", options.observer.features.descriptor),
                      start.descriptor(),
                      fmt::format("Run with --set detector={0} --set descriptor={0}.", start.descriptor())});
}

/// Carries out one run.
class SlamPipeline {
 public:
  SlamPipeline(const SlamOptions& options, const StereoNoise& stereo, const Executor& executor,
               SlamResult& result)
      : options_(options),
        executor_(executor),
        result_(result),
        indexed_(std::move(result.map)),
        tracker_(options, executor, indexed_),
        mapper_(options, executor, indexed_, result.times),
        closer_(options, executor, indexed_),
        min_disparity_sigmas_(stereo.min_disparity_sigmas),
        calibrator_(indexed_.map().rig(), stereo, executor) {}

  /// Weighs depths by a noise that is estimated, unless the options state it.
  void estimate_depth_noise() { depth_noise_.emplace(indexed_.map(), options_.observer.depth_noise); }

  void process(ObservedFrame&& frame) {
    calibrator_.correct(frame);
    if (depth_noise_) depth_noise_->weigh(frame);
    TrackingResult track = track_frame(std::move(frame));
    if (tracker_.lost()) {
      begin_component(track);
    } else if (track.status == TrackingStatus::keyframe) {
      const KeyframeId keyframe = insert_keyframe();
      close_loops(keyframe);
      refer_to(keyframe, track);
      if (calibrator_.is_due(indexed_.map())) calibrate();
      if (depth_noise_ && depth_noise_->is_due(indexed_.map())) weigh_depths();
      mapper_.start_adjustment(keyframe);
    }
    result_.frames.push_back(track);
  }

  void finish() {
    (void)mapper_.apply_adjustment();
    calibrate();
    if (depth_noise_) finish_depths();
    result_.disparity_calibration = calibrator_.result();
    mapper_.finish(calibrator_.result().applied ? SharedField::estimated : SharedField::none);
    if (!options_.odometry) memory_.refine(indexed_.map(), options_, executor_, result_.frames);
    (void)cull_landmarks(indexed_.edit());
    result_.covariances = mapper_.covariances();
    result_.keyframe_covariances = mapper_.keyframe_covariances();
    result_.loops = closer_.report();
    mapper_.fill_graphs(closer_.edges(), result_.graph_before, result_.graph_after);
    result_.map = indexed_.release();
  }

 private:
  TrackingResult track_frame(ObservedFrame&& frame) {
    const Stopwatch watch;
    if (mapper_.apply_adjustment_if_due()) tracker_.follow_map();
    TrackingResult track = tracker_.track(std::move(frame));
    result_.times.tracking.push_back(watch.seconds());
    if (tracker_.lost()) return track;
    mapper_.found();
    if (!options_.odometry)
      memory_.remember(result_.frames.size(), tracker_.last_observed(), tracker_.last());
    return track;
  }

  void begin_component(TrackingResult& track) {
    const auto keyframe = mapper_.begin_component(tracker_.last_observed());
    if (!keyframe) return;
    track.status = TrackingStatus::keyframe;
    refer_to(*keyframe, track);
  }

  KeyframeId insert_keyframe() {
    if (mapper_.apply_adjustment()) tracker_.follow_map();
    return mapper_.insert(tracker_.last_observed(), tracker_.last(), tracker_.reference());
  }

  void close_loops(KeyframeId keyframe) {
    const Stopwatch watch;
    if (options_.close_loops && !options_.odometry) (void)closer_.close(keyframe);
    result_.times.loops.push_back(watch.seconds());
  }

  void calibrate() {
    const Stopwatch watch;
    const int estimates = calibrator_.result().estimates;
    const auto taken_off = calibrator_.update(indexed_.edit());
    if (calibrator_.result().estimates > estimates) result_.times.global.push_back(watch.seconds());
    if (taken_off) {
      memory_.correct_disparities(indexed_.map().rig(), *taken_off, min_disparity_sigmas_);
      tracker_.correct_disparities(*taken_off, min_disparity_sigmas_);
      tracker_.follow_map();
    }
  }

  void weigh_depths() {
    const Stopwatch watch;
    if (const auto noise = depth_noise_->update(indexed_.edit())) {
      memory_.weigh_disparities(indexed_.map().rig(), *noise);
      tracker_.weigh_disparities(*noise);
    }
    result_.times.global.push_back(watch.seconds());
  }

  void finish_depths() {
    memory_.weigh_disparities(indexed_.map().rig(), depth_noise_->finish(indexed_.edit()));
    result_.depth_noise = depth_noise_->result();
  }

  /// Makes the keyframe, made of the last frame, the reference of tracking.
  void refer_to(KeyframeId keyframe, TrackingResult& track) {
    tracker_.refer_to(keyframe);
    track.reference = keyframe;
    track.reference_from_frame = {};
  }

  const SlamOptions& options_;
  const Executor& executor_;
  SlamResult& result_;
  IndexedMap indexed_;
  Tracker tracker_;
  Mapper mapper_;
  LoopCloser closer_;
  double min_disparity_sigmas_;
  DisparityCalibrator calibrator_;
  std::optional<DepthNoiseEstimator> depth_noise_;  // of an RGB-D camera
  FrameMemory memory_;
};

/// Returns the options with the median time between neighbouring frames, unless they state another.
SlamOptions with_frame_period(const SlamOptions& given, const Sequence& sequence) {
  SlamOptions options = given;
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < sequence.frames.size(); ++i)
    periods.push_back(sequence.frames[i].stamp_ns - sequence.frames[i - 1].stamp_ns);
  if (given.frame_period_s > 0 || periods.empty()) return options;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  options.frame_period_s = 1e-9 * static_cast<double>(*middle);
  return options;
}

/// Warns of frames that were refused because of max_motion.
void warn_of_refused(const SlamResult& result, const SlamOptions& options, Progress& progress) {
  const auto refused =
      std::count_if(result.frames.begin(), result.frames.end(), [](const TrackingResult& track) {
        return !track.tracked() && track.status == TrackingStatus::implausible;
      });
  if (refused == 0) return;
  progress.warn(
      fmt::format("{} of {} frames moved further than max_motion = {:g} (rad + m) allows between neighbours "
                  "and were refused. Give "
                  "a larger max_motion where the camera is that fast.",
                  refused, result.frames.size(), options.max_motion));
}

MapHeader map_header(const Sequence& sequence, const SlamOptions& options) {
  MapHeader header;
  header.rig = rig_of(sequence.calibration, options.observer.depth_noise);
  header.width = sequence.calibration.camera.width;
  header.height = sequence.calibration.camera.height;
  header.right_correction = sequence.calibration.right_correction;
  header.descriptor.name = options.observer.features.descriptor;
  return header;
}

/// Returns the sequence as the start map's keyframes were observed.
Sequence with_correction_of(const Map& start, Sequence sequence) {
  if (start.header().right_correction)
    sequence.calibration.right_correction = start.header().right_correction;
  return sequence;
}

/// Returns how the field of disparities is to be found: not of a start map, whose disparities are of an
/// earlier run, nor in odometry, which never adjusts the whole map.
StereoNoise calibration_of_disparities(const Sequence& sequence, const SlamOptions& options, bool has_start) {
  StereoNoise noise = options.observer.stereo_noise;
  if (!is_stereo(sequence) || has_start || options.odometry) noise.self_calibration = "off";
  return noise;
}

}  // namespace

std::int32_t SlamResult::main_component() const {
  std::map<std::int32_t, std::size_t> counts;
  for (const TrackingResult& track : frames)
    if (track.tracked()) ++counts[map.component_of(*track.reference)];
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 0 : most->first;
}

Trajectory SlamResult::trajectory() const {
  Trajectory trajectory;
  const std::int32_t component = main_component();
  for (const TrackingResult& track : frames) {
    if (!track.tracked() || map.component_of(*track.reference) != component) continue;
    trajectory.push_back({track.stamp_ns, WorldFromCamera(map.world_from_camera(*track.reference) *
                                                          track.reference_from_frame)});
  }
  return trajectory;
}

Trajectory SlamResult::keyframe_trajectory() const {
  Trajectory trajectory;
  const std::int32_t component = main_component();
  for (const Keyframe& keyframe : map.keyframes()) {
    const bool is_of_sequence = keyframe.observed.frame.valid();  // and not of the start map
    if (!keyframe.erased && keyframe.component == component && is_of_sequence)
      trajectory.push_back({keyframe.observed.stamp_ns, WorldFromCamera(keyframe.world_from_camera)});
  }
  return trajectory;
}

SlamResult run_slam(const Sequence& recorded, const SlamOptions& given, const Executor& executor,
                    Progress& progress, std::optional<Map> start) {
  given.validate();
  require_depth(recorded);
  const SlamOptions options = with_frame_period(given, recorded);
  if (start) {
    require_same(*start, rig_of(recorded.calibration, options.observer.depth_noise), options);
    start->end_recording();
  }
  const AlignedRows aligned = align_rows(start ? with_correction_of(*start, recorded) : recorded,
                                         options.observer.stereo_noise.self_calibration, executor);
  const Sequence& sequence = aligned.sequence;
  SlamResult result;
  result.row_errors = aligned.errors;
  result.rows_aligned = aligned.applied;
  result.start_keyframes = start ? start->keyframe_ids().size() : 0;
  const StereoNoise stereo = calibration_of_disparities(sequence, options, start.has_value());
  result.map = start ? std::move(*start) : Map(map_header(sequence, options));
  SlamPipeline pipeline(options, stereo, executor, result);
  if (!is_stereo(sequence)) pipeline.estimate_depth_noise();
  FrameStream stream{"tracking"};
  stream.process = [&](std::size_t, LoadedFrame&& loaded) {
    result.times.decode.push_back(loaded.decode_seconds);
    result.times.features.push_back(loaded.feature_seconds);
    if (!loaded.failure) pipeline.process(std::move(loaded.observed));
  };
  const FrameStreamReport report =
      observe_frames(sequence, FrameObserver(sequence, options.observer), stream, executor, progress);
  result.stopped = report.stopped;
  result.unreadable = report.unreadable;
  pipeline.finish();
  warn_of_refused(result, options, progress);
  return result;
}

}  // namespace cairn
