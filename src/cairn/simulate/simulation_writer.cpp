// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/simulation_writer.h"

#include <system_error>

#include "cairn/core/error.h"

namespace cairn {
namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(
        {folder.string(), 0, "to create the folder", error.message(), "Check the path and the disk."});
}

int write_frames(std::string_view stage, int count, const Executor& executor, Progress& progress,
                 const std::function<std::vector<fs::path>(int)>& write_frame) {
  std::vector<std::vector<fs::path>> written(static_cast<std::size_t>(count));
  int done = 0;
  progress.start(stage, count, "frames");
  executor.ordered_pipeline<bool>(
      written.size(),
      [&](std::size_t i) {
        written[i] = write_frame(static_cast<int>(i));
        return true;
      },
      [&](std::size_t i, bool&&) {
        done = static_cast<int>(i) + 1;
        progress.update(done);
        return !progress.stop_requested();
      });
  progress.finish();
  for (std::size_t i = static_cast<std::size_t>(done); i < written.size(); ++i) {
    std::error_code ignored;
    for (const fs::path& path : written[i]) fs::remove(path, ignored);
  }
  return done;
}

SimulationReport report_on(const Trajectory& truth, int frames) {
  SimulationReport report;
  report.frames = frames;
  report.stopped = static_cast<std::size_t>(frames) < truth.size();
  for (std::size_t i = 1; i < static_cast<std::size_t>(frames); ++i) {
    const Rigid3 &before = truth[i - 1].world_from_camera, &now = truth[i].world_from_camera;
    report.length += (now.translation - before.translation).norm();
  }
  if (frames > 0) {
    const auto& last = truth[static_cast<std::size_t>(frames) - 1];
    report.duration = static_cast<double>(last.stamp_ns - truth[0].stamp_ns) * 1e-9;
  }
  return report;
}

}  // namespace cairn
