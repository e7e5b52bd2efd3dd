// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/survey/survey.h"

namespace cairn {

/// Holds what is told of a survey beside what became of the landmarks.
struct SurveySummary {
  std::string folder;        ///< of the map, as the user named it
  std::string poses_format;  ///< of the given poses
  std::int64_t sequence_frames = 0;
  int threads = 1;
  double total_seconds = 0;
  std::string image_root;  ///< that names in the model for COLMAP are relative to; empty: none was written
  double peak_memory_mb = 0;
};

/// Returns report.json, which lies in the map's folder: counts, the same in every run.
[[nodiscard]] std::string format_survey_report(const SurveyResult& result);
/// Returns the report with the times and the memory of this run: what --json prints.
[[nodiscard]] std::string format_survey_json(const SurveyResult& result, const SurveySummary& summary);
/// Returns what the program prints in the end, for people.
[[nodiscard]] std::string format_survey_text(const SurveyResult& result, const SurveySummary& summary);

}  // namespace cairn
