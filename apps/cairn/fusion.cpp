// SPDX-License-Identifier: Apache-2.0
#include "fusion.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace cairn::app {
PosedSequence open_posed_sequence(const SequenceArguments& arguments, const PoseArguments& poses) {
  PosedSequence posed{open_sequence(arguments.folder, arguments.options()), {}};
  print_warnings(posed.sequence.report.warnings);
  posed.world_from_camera = read_reported_poses(posed.sequence, poses);
  return posed;
}

void print_report(const FusionReport& report) {
  fmt::print("frames       {} of {} fused", report.fused, report.frames);
  if (report.without_pose > 0) fmt::print(", {} without pose", report.without_pose);
  if (report.without_depth > 0) fmt::print(", {} without depth", report.without_depth);
  if (report.unreadable > 0) fmt::print(", {} unreadable", report.unreadable);
  fmt::print("{}\n", report.stopped ? ", stopped by the user" : "");
}

nlohmann::ordered_json to_json(const FusionReport& report) {
  return {{"total", report.frames},
          {"fused", report.fused},
          {"without_pose", report.without_pose},
          {"without_depth", report.without_depth},
          {"unreadable", report.unreadable},
          {"stopped", report.stopped}};
}

std::string format_bytes(std::int64_t bytes) {
  if (bytes < 1000) return fmt::format("{} bytes", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", 1e-3 * static_cast<double>(bytes));
  return fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

}  // namespace cairn::app
