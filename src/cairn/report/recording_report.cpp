// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/recording_report.h"

#include <nlohmann/json.hpp>

#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"

namespace cairn {

std::string format_simulation_text(const SimulationSummary& summary) {
  const SimulationReport& report = summary.report;
  TextBuilder text;
  text.add("frames       {} over {:.2f} s{}\n", report.frames, report.duration,
           report.stopped ? ", stopped before the end" : "");
  text.add("path         {:.3f} m\n", report.length);
  text.add("written to   {}\n", summary.folder);
  text.add("next         {}\n", summary.next);
  return text.take();
}

std::string format_simulation_json(const SimulationSummary& summary) {
  const SimulationReport& report = summary.report;
  return format_document({{"frames", report.frames},
                          {"duration_s", report.duration},
                          {"path_m", report.length},
                          {"seed", summary.seed},
                          {"stopped", report.stopped},
                          {"folder", summary.folder}});
}

std::string format_rectified_text(const RectifiedReport& report, const std::string& folder) {
  TextBuilder text;
  text.add("frames       {}{}\n", report.frames, report.stopped ? ", stopped before the end" : "");
  if (report.unreadable > 0) text.add("unreadable   {} frames, skipped\n", report.unreadable);
  text.add("poses        {}\n", report.has_poses ? "of every frame" : "none: not every frame has a true one");
  text.add("written to   {}\n", folder);
  return text.take();
}

std::string format_rectified_json(const RectifiedReport& report, const std::string& folder) {
  return format_document({{"frames", report.frames},
                          {"unreadable", report.unreadable},
                          {"poses", report.has_poses},
                          {"stopped", report.stopped},
                          {"folder", folder}});
}

}  // namespace cairn
