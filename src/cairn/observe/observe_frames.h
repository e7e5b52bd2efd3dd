// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/observe/frame_observer.h"

namespace cairn {

/// What happens to the frames of a sequence. `index` is the position of a frame in the sequence.
struct FrameStream {
  std::string activity;           ///< for the progress, such as "tracking"
  std::string noun = "frame";     ///< what a frame is called in warnings
  bool resumes_readable = false;  ///< a run that this one resumes could read a frame
  /// Processes one frame, in the order of the sequence; also one that could not be read
  /// (LoadedFrame::failure).
  std::function<void(std::size_t index, LoadedFrame&& loaded)> process = {};
  /// Prepares one frame that could be read, for several frames at once and before `process`; may be empty.
  std::function<void(std::size_t index, const LoadedFrame& loaded)> prepare = {};
};

struct FrameStreamReport {
  std::vector<std::string> unreadable;  ///< what is wrong with each frame that could not be read
  bool stopped = false;                 ///< by request, before the last frame of the sequence
};

/// Decodes and observes the frames at `indices` (increasing) on all threads and processes them in order, with
/// progress and until a stop is requested. Warns of frames that cannot be read and leaves them out. Throws
/// InputError if none can be read.
[[nodiscard]] FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                               std::span<const std::size_t> indices,
                                               const FrameStream& stream, const Executor& executor,
                                               Progress& progress);

/// The same for all frames.
[[nodiscard]] FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                               const FrameStream& stream, const Executor& executor,
                                               Progress& progress);

}  // namespace cairn
