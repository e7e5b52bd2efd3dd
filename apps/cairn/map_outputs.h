// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/survey/survey.h"

namespace cairn::app {

/// What `cairn map` says in the end, beside what became of the landmarks.
struct MapSummary {
  std::string folder;
  std::string poses_format;
  std::int64_t sequence_frames = 0;
  int threads = 1;
  double total_seconds = 0;
  std::string image_root;  ///< that names in the model for COLMAP are relative to; empty: none was written
};

/// The report in the map's folder: counts, the same in every run.
[[nodiscard]] std::string format_map_report(const SurveyResult& result);
/// The report, with the times and the memory of this run: what --json prints.
[[nodiscard]] std::string format_map_json(const SurveyResult& result, const MapSummary& summary);
void print_map_summary(const SurveyResult& result, const MapSummary& summary);

}  // namespace cairn::app
