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

/// Says what is done with the frames of a sequence. `index` is the position of a frame in the sequence.
struct FrameStream {
  std::string activity;           ///< shown with the progress, such as "tracking"
  std::string noun = "frame";     ///< word for a frame in warnings
  bool resumes_readable = false;  ///< whether a run that this one resumes could read a frame
  /// Processes one frame, in the order of the sequence; also a frame that could not be read
  /// (LoadedFrame::failure).
  std::function<void(std::size_t index, LoadedFrame&& loaded)> process = {};
  /// Prepares one frame that could be read, for several frames at once and before `process`; may be empty.
  std::function<void(std::size_t index, const LoadedFrame& loaded)> prepare = {};
};

/// Reports which frames could not be read, and whether the stream was stopped.
struct FrameStreamReport {
  std::vector<std::string> unreadable;  ///< messages about the frames that could not be read
  bool stopped = false;  ///< whether it was stopped by request, before the last frame of the sequence
};

/// Decodes and observes the frames at `indices` (ascending) on all threads and processes them in order, with
/// progress, until a stop is requested. Warns of frames that cannot be read. Throws InputError if there were
/// such frames and none could be read.
[[nodiscard]] FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                               std::span<const std::size_t> indices,
                                               const FrameStream& stream, const Executor& executor,
                                               Progress& progress);

/// Decodes, observes and processes all frames of the sequence.
[[nodiscard]] FrameStreamReport observe_frames(const Sequence& sequence, const FrameObserver& observer,
                                               const FrameStream& stream, const Executor& executor,
                                               Progress& progress);

}  // namespace cairn
