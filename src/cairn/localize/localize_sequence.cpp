// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/localize_sequence.h"

#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/localize/motion_check.h"
#include "cairn/observe/observe_frames.h"

namespace cairn {
namespace {

class LocalizePipeline {
 public:
  LocalizePipeline(const Localizer& localizer, const Sequence& sequence,
                   const LocalizeSequenceOptions& options)
      : localizer_(localizer), sequence_(sequence), options_(options), images_(sequence.frames.size()) {
    if (sequence.has_times) motion_.emplace(options.trust);
  }

  void prepare(std::size_t index, const LoadedFrame& loaded) {
    localize(index, loaded, options_.priors.empty() ? std::nullopt : options_.priors[index]);
  }

  void process(std::size_t index, const LoadedFrame& loaded) {
    if (loaded.failure) return;
    if (options_.follow) localize(index, loaded, last_);
    LocalizedImage& image = images_[index];
    image.position = static_cast<std::int64_t>(index);
    image.stamp_ns = loaded.observed.stamp_ns;
    image.file = sequence_.frames[index].color.filename().string();
    image.feature_seconds = loaded.feature_seconds;
    if (motion_) motion_->check(image.stamp_ns, image.found);
    if (image.found.verdict == Verdict::good) last_ = image.found.camera_from_world.inverse();
    result_.images.push_back(std::move(image));
  }

  [[nodiscard]] LocalizedSequence take_result() { return std::move(result_); }

 private:
  void localize(std::size_t index, const LoadedFrame& loaded, const std::optional<WorldFromCamera>& prior) {
    Stopwatch watch;
    images_[index].found = localizer_.localize(loaded.observed, prior);
    images_[index].localize_seconds = watch.lap();
  }

  const Localizer& localizer_;
  const Sequence& sequence_;
  const LocalizeSequenceOptions& options_;
  std::vector<LocalizedImage> images_;  // of each frame, on its way to the result
  std::optional<MotionCheck> motion_;   // none if nothing is known about time
  std::optional<WorldFromCamera> last_;
  LocalizedSequence result_;
};

}  // namespace

LocalizedSequence localize_sequence(const Localizer& localizer, const Sequence& sequence,
                                    const FrameObserver& observer, const LocalizeSequenceOptions& options,
                                    const Executor& executor, Progress& progress) {
  require(options.priors.empty() || options.priors.size() == sequence.frames.size(),
          "each image has a prior, or none has");
  LocalizePipeline pipeline(localizer, sequence, options);
  FrameStream stream{"localising", "image"};
  if (!options.follow)
    stream.prepare = [&](std::size_t index, const LoadedFrame& loaded) { pipeline.prepare(index, loaded); };
  stream.process = [&](std::size_t index, LoadedFrame&& loaded) { pipeline.process(index, loaded); };
  const FrameStreamReport report = observe_frames(sequence, observer, stream, executor, progress);
  LocalizedSequence result = pipeline.take_result();
  result.unreadable = report.unreadable;
  return result;
}

}  // namespace cairn
