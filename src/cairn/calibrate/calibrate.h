// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cairn/calibrate/pose_calibration.h"
#include "cairn/calibrate/quantity.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/observe/row_errors.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/sequence/pose_path.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Sets how a recording is calibrated.
struct CalibrateOptions {
  SlamOptions
      slam;  ///< of the SLAM that shows what disparities and motions are; its self-calibration is "auto"
  /// Whether a baseline (of RGB-D, a depth scale) that is off is corrected in the calibration that is made.
  bool apply_baseline = false;
};

/// Holds what a recording says of its calibration.
struct CalibrationResult {
  std::vector<Quantity> quantities;  ///< in the order in which people read them
  RowErrors rows;                    ///< of the right images, what the stated correction leaves
  bool rows_applied = false;
  DisparityCalibration disparities;      ///< what the stated correction leaves
  std::optional<PoseCalibration> poses;  ///< nullopt without given poses
  Calibration calibration;               ///< the stated one with what is off, see Quantity::is_written
  std::size_t frames = 0, tracked = 0;
  std::size_t unreadable = 0;  ///< frames that were skipped
  bool stopped = false;        ///< whether the user stopped before the last frame

  /// Returns whether the recording determines anything.
  [[nodiscard]] bool has_answer() const;
};

/// Finds what is wrong with the calibration of a stereo or RGB-D recording: of a pair the rows and the field
/// of disparities (measure_row_errors, run_slam's self-calibration), what is left of them if the calibration
/// states a correction already; with given poses also the baseline or the depth scale, the poses' time
/// offset, boresight and lever arm (calibrate_poses). The same bits at any number of threads. Throws
/// InputError as run_slam does.
[[nodiscard]] CalibrationResult calibrate(const Sequence& sequence, const std::optional<GivenPath>& given,
                                          const CalibrateOptions& options, const Executor& executor,
                                          Progress& progress);

}  // namespace cairn
