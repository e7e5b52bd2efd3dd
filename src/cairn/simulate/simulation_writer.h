// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// What was simulated.
struct SimulationReport {
  int frames = 0;       ///< fewer than asked for where the user stopped
  double length = 0;    ///< metres between the first camera and the last, along the way
  double duration = 0;  ///< seconds between the first frame and the last
  bool stopped = false;
};

/// Makes a folder; InputError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes the images of frames 0 to count - 1 in parallel, a stage of that name. `write_frame(i)` returns the
/// paths that it wrote. Where `progress` asks to stop, frames begun after the last one counted are removed
/// again. Returns how many frames are complete.
[[nodiscard]] int write_frames(std::string_view stage, int count, const Executor& executor,
                               Progress& progress,
                               const std::function<std::vector<std::filesystem::path>(int)>& write_frame);

/// Report on the first `frames` poses.
[[nodiscard]] SimulationReport report_on(const Trajectory& truth, int frames);

}  // namespace cairn
