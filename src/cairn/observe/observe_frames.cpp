// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/observe_frames.h"

#include <numeric>

#include "cairn/sequence/skipped_frames.h"

namespace cairn {

FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                 std::span<const std::size_t> indices, const FrameStream& stream,
                                 const Executor& executor, Progress& progress) {
  FrameStreamReport report;
  SkippedFrames skipped(progress, stream.noun);
  if (stream.resumes_readable) skipped.take();
  const auto observe = [&](std::size_t k) {
    LoadedFrame loaded = observer.load(indices[k]);
    if (stream.prepare && !loaded.failure) stream.prepare(indices[k], loaded);
    return loaded;
  };
  const auto process = [&](std::size_t k, LoadedFrame&& loaded) {
    loaded.failure ? skipped.skip(loaded.failure) : skipped.take();
    stream.process(indices[k], std::move(loaded));
    progress.update(static_cast<std::int64_t>(indices[k]) + 1);
    report.stopped = progress.stop_requested() && indices[k] + 1 < sequence.frames.size();
    return !report.stopped;
  };
  progress.start(stream.activity, static_cast<std::int64_t>(sequence.frames.size()), stream.noun + "s");
  executor.ordered_pipeline<LoadedFrame>(indices.size(), observe, process);
  progress.finish();
  skipped.finish();
  report.unreadable = skipped.messages();
  return report;
}

FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                 const FrameStream& stream, const Executor& executor, Progress& progress) {
  std::vector<std::size_t> all(sequence.frames.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return observe_frames(sequence, observer, all, stream, executor, progress);
}

}  // namespace cairn
