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

/// Describes what was simulated.
struct SimulationReport {
  int frames = 0;       ///< fewer than asked for if the user stopped
  double length = 0;    ///< metres along the path from the first camera to the last
  double duration = 0;  ///< seconds between the first frame and the last
  bool stopped = false;
};

/// Makes a folder. Throws InputError if that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes the images of frames 0 to count - 1 in parallel, as a stage of that name. `write_frame(i)` returns
/// the paths that it wrote. If `progress` asks to stop, removes frames begun after the last one counted.
/// Returns the number of complete frames.
[[nodiscard]] int write_frames(std::string_view stage, int count, const Executor& executor,
                               Progress& progress,
                               const std::function<std::vector<std::filesystem::path>(int)>& write_frame);

/// Reports on the first `frames` poses.
[[nodiscard]] SimulationReport report_on(const Trajectory& truth, int frames);

}  // namespace cairn
