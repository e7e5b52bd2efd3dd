// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/calibrate/calibrate.h"
#include "cairn/sequence/pose_path.h"

namespace cairn {

/// Describes a run of `cairn calibrate`, for its reports.
struct CalibrationSummary {
  const CalibrationResult& result;
  const std::optional<GivenPath>& given;
  std::string output;  ///< the calibration that was written; empty: none
};

/// Returns the table of the quantities and what to do about those that are off.
[[nodiscard]] std::string format_calibration_text(const CalibrationSummary& summary);
/// Returns a JSON object with the same figures and those of the pair's self-calibration.
[[nodiscard]] std::string format_calibration_json(const CalibrationSummary& summary);

}  // namespace cairn
