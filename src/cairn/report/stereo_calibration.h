// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/observe/row_errors.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/report/json_pieces.h"

namespace cairn {

/// Refers to what a run found out about the calibration of its stereo pair.
struct StereoCalibrationFigures {
  const RowErrors& rows;
  bool rows_aligned;
  const DisparityCalibration& disparities;
};

/// Returns the figures with what was done; null if nothing was measured.
[[nodiscard]] Json to_json(const StereoCalibrationFigures& figures);

/// Returns the line that the program prints, without its end; empty if nothing was measured.
[[nodiscard]] std::string describe(const StereoCalibrationFigures& figures);

}  // namespace cairn
