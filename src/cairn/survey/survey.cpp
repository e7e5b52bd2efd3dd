// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/observe/observe_frames.h"
#include "cairn/survey/checkpoint.h"
#include "cairn/survey/diagnosis.h"
#include "cairn/survey/disparities_by_poses.h"
#include "cairn/survey/identity.h"
#include "cairn/survey/pose_adjustment.h"
#include "cairn/survey/surveyor.h"

namespace cairn {
namespace {

void check(const SurveyInput& input) {
  const Calibration& calibration = input.sequence.calibration;
  require(input.poses.frames.size() == input.sequence.frames.size(), "one pose, or none, for each frame");
  if (calibration.depth || calibration.baseline) return;
  throw InputError(
      {input.sequence.folder.string(), 0, "a stereo or an RGB-D sequence", "images of one camera",
       "A landmark's distance comes from a second image or a depth image: camera.yaml needs a section "
       "'right' or 'depth'."});
}

/// Returns the name of the descriptors, with their norm and size as the extractor makes them.
DescriptorKind kind_of(const FeatureOptions& options) {
  const Descriptors descriptors = make_extractor(options)->extract(GrayImage(1, 1)).descriptors;
  return {options.descriptor, descriptors.norm(), static_cast<std::uint32_t>(descriptors.bytes())};
}

MapHeader header_of(const SurveyInput& input, const Calibration& calibration, const SurveyOptions& options) {
  MapHeader header;
  header.rig = rig_of(calibration, options.observer.depth_noise);
  header.right_correction = calibration.right_correction;
  if (calibration.depth) header.depth_noise = options.observer.depth_noise.stated;
  header.width = calibration.camera.width;
  header.height = calibration.camera.height;
  header.descriptor = kind_of(options.observer.features);
  header.origin = input.poses.origin;
  header.world = header.origin ? "east, north and up at the origin" : "that of the given poses";
  header.settings = input.settings;
  return header;
}

/// Carries out one run, from the checkpoint of an earlier one or from the beginning.
class SurveyPipeline {
 public:
  SurveyPipeline(const SurveyInput& input, const SurveyOptions& options, const std::filesystem::path& folder,
                 const Executor& executor, Progress& progress)
      : input_(input),
        options_(options),
        folder_(folder),
        executor_(executor),
        progress_(progress),
        identity_(identity_of(input)),
        rig_(rig_of(input.sequence.calibration, options.observer.depth_noise)) {}

  [[nodiscard]] SurveyResult run() {
    try {
      align();
      check_given_poses();
      calibrate();
      begin();
      follow();
      if (!result_.stopped) finish();
      return summarise();
    } catch (const InputError&) {
      // What was kept is sound unless this run came from it: a full disk can be emptied.
      if (result_.resumed_at > 0) discard_kept();
      throw;
    } catch (...) {
      discard_kept();
      throw;
    }
  }

 private:
  /// Discards the checkpoint, because a run that failed for a reason of its own would fail again from there.
  void discard_kept() {
    if (!has_checkpoint(folder_)) return;
    remove_checkpoint(folder_);
    progress_.warn(
        "the work that was kept is discarded, since this run failed: the same command begins anew");
  }

  /// Corrects the rows of right images, where that matters.
  void align() {
    auto aligned = align_rows(input_.sequence, options_.observer.stereo_noise.self_calibration, executor_);
    result_.row_errors = aligned.errors;
    result_.rows_aligned = aligned.applied;
    sequence_ = std::move(aligned.sequence);
  }

  /// Corrects disparities, where that matters and the poses do not contradict the images, and decides how
  /// frames are observed from now on.
  void calibrate() {
    DisparityCalibration& found = result_.disparity_calibration;
    found = calibrate_by_poses(sequence_, input_.poses, options_, executor_);
    if (result_.pose_check.verdict == PoseVerdict::contradiction) found.applied = false;
    if (found.applied) {
      StereoCorrection correction = sequence_.calibration.right_correction.value_or(StereoCorrection{});
      correction.disparity += found.field;
      sequence_.calibration.right_correction = correction;
    }
    estimate_depth_noise();
    observer_.emplace(sequence_, options_.observer);
  }

  /// Estimates the noise of depth, unless the poses contradict the images: then it would be theirs.
  void estimate_depth_noise() {
    if (!sequence_.calibration.depth) return;
    DepthNoise& noise = options_.observer.depth_noise;
    if (result_.pose_check.verdict != PoseVerdict::contradiction)
      result_.depth_noise = depth_noise_by_poses(sequence_, input_.poses, options_, executor_);
    if (!result_.depth_noise) result_.depth_noise = {noise.at_start(), rig_, 0, noise.is_estimated()};
    noise.stated = result_.depth_noise->noise;
  }

  void check_given_poses() {
    PoseCheck& check = result_.pose_check;
    check = check_poses(sequence_, input_.poses, options_.observer, executor_);
    refuse_misread(check, sequence_, input_.poses);
    if (check.verdict != PoseVerdict::contradiction) return;
    progress_.warn(
        fmt::format("the given poses contradict the images: {}. No misreading that is known explains "
                    "it; look at their noise, their clock (--pose-offset) and the calibration",
                    describe(check)));
  }

  void begin() {
    const MapHeader header = header_of(input_, sequence_.calibration, options_);
    auto checkpoint =
        read_checkpoint(folder_, identity_, [&](std::vector<SurveyFrame>& frames) { observe_again(frames); });
    if (checkpoint) checkpoint = open_kept(header, std::move(*checkpoint));
    if (!checkpoint) writer_ = std::make_unique<MapWriter>(folder_, header);
    SurveyState state = checkpoint ? std::move(checkpoint->state) : SurveyState{};
    result_.resumed_at = static_cast<std::int64_t>(state.next_in_sequence);
    surveyor_ = std::make_unique<Surveyor>(rig_, options_, std::move(state), *writer_);
  }

  /// Opens the map that the checkpoint belongs to. Returns nullopt if a piece of it was changed or lost.
  std::optional<Checkpoint> open_kept(const MapHeader& header, Checkpoint&& checkpoint) {
    try {
      writer_ = std::make_unique<MapWriter>(folder_, header, checkpoint.writer);
      return std::move(checkpoint);
    } catch (const InputError& error) {
      progress_.warn(fmt::format("begins anew, as the work that was kept is damaged: {}", error.what()));
      return std::nullopt;
    }
  }

  void finish() {
    require_frames();
    surveyor_->finish(executor_);
    writer_->finish(surveyor_->state().held_out);
    MapWriter::discard_append_files(folder_);
    remove_checkpoint(folder_);
  }

  void observe_again(std::vector<SurveyFrame>& frames) const {
    executor_.for_each(frames.size(), [&](std::size_t i) {
      const auto index = frames[i].observed.frame.index();
      LoadedFrame loaded = observer_->load(index);
      if (loaded.failure) std::rethrow_exception(loaded.failure);
      if (!frames[i].kept.empty() && frames[i].kept.back() >= loaded.observed.observations.size())
        throw InputError({input_.sequence.frames[index].color.string(), 0, "the image of the earlier run",
                          "another one", "Begin anew."});
      scale_sigmas(options_.covariance.sigma_px, loaded.observed);
      frames[i].observed = select(loaded.observed, frames[i].kept);
      frames[i].given = *input_.poses.frames[index];
    });
  }

  void follow() {
    const std::size_t first = surveyor_->state().next_in_sequence;
    std::vector<std::size_t> todo;
    for (std::size_t i = first; i < input_.sequence.frames.size(); ++i) {
      if (input_.poses.frames[i]) todo.push_back(i);
    }
    SurveyState& state = surveyor_->state();
    state.counts.without_pose = static_cast<std::int64_t>(input_.poses.without_pose);
    FrameStream stream{"mapping"};
    stream.resumes_readable = state.counts.frames > 0;
    stream.process = [this](std::size_t index, LoadedFrame&& loaded) { process(index, loaded); };
    result_.stopped = observe_frames(sequence_, *observer_, todo, stream, executor_, progress_).stopped;
    if (result_.stopped) keep();
  }

  void process(std::size_t index, const LoadedFrame& loaded) {
    result_.times.decode += loaded.decode_seconds;
    result_.times.features += loaded.feature_seconds;
    SurveyState& state = surveyor_->state();
    loaded.failure ? void(++state.counts.unreadable)
                   : surveyor_->add(loaded.observed, *input_.poses.frames[index], executor_);
    state.next_in_sequence = index + 1;
    if (progress_.stop_requested() || since_checkpoint_.seconds() > kCheckpointSeconds) keep();
  }

  void require_frames() const {
    const SurveyCounts& counts = surveyor_->state().counts;
    if (counts.frames > 0) return;
    throw InputError({input_.sequence.folder.string(), 0, "a frame with a pose that can be read",
                      fmt::format("{} that cannot be read", counts.unreadable),
                      "Look at what was said of each of them."});
  }

  void keep() {
    write_checkpoint(folder_, identity_, surveyor_->state(), writer_->save());
    since_checkpoint_ = Stopwatch();
  }

  SurveyResult summarise() {
    const SurveyState& state = surveyor_->state();
    const SurveyTimes& times = surveyor_->times();
    result_.stated = stated_deviations(input_.poses);
    result_.moves = summarise_moves(state.moves);
    result_.counts = state.counts;
    result_.times.matching = times.matching;
    result_.times.poses = times.poses;
    result_.times.adjustment = times.adjustment;
    result_.times.merging = times.merging;
    result_.times.writing = times.writing;
    result_.noise = state.variance.prior();
    result_.held_out = state.held_out;
    result_.landmark_noise = state.noise.noise();
    const auto frames = static_cast<double>(std::max<std::int64_t>(1, state.counts.frames));
    result_.moved_rms_m = std::sqrt(state.counts.moved_squared_m / frames);
    result_.turned_rms_deg = std::sqrt(state.counts.turned_squared_rad / frames) * 180 / std::numbers::pi;
    const auto landmarks = static_cast<double>(std::max<std::int64_t>(1, state.counts.landmarks));
    result_.image_std_rms_m = std::sqrt(state.counts.image_variance_m2 / landmarks);
    result_.pose_std_rms_m = std::sqrt(state.counts.pose_variance_m2 / landmarks);
    return result_;
  }

  static constexpr double kCheckpointSeconds = 2;  // what a crash costs, beside finding features again

  const SurveyInput& input_;
  SurveyOptions options_;  // with the noise of depth, once it is estimated
  const std::filesystem::path& folder_;
  const Executor& executor_;
  Progress& progress_;
  std::uint32_t identity_;
  Rig rig_;
  Sequence sequence_;  // the input's, as it is corrected
  std::optional<FrameObserver> observer_;
  std::unique_ptr<MapWriter> writer_;
  std::unique_ptr<Surveyor> surveyor_;
  Stopwatch since_checkpoint_;
  SurveyResult result_;
};

}  // namespace

SurveyResult run_survey(const SurveyInput& input, const SurveyOptions& options,
                        const std::filesystem::path& folder, const Executor& executor, Progress& progress) {
  options.validate();
  check(input);
  return SurveyPipeline(input, options, folder, executor, progress).run();
}

bool has_unfinished_survey(const std::filesystem::path& folder) {
  return has_checkpoint(folder);
}

}  // namespace cairn
