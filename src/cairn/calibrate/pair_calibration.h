// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/calibrate/quantity.h"
#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/observe/row_errors.h"
#include "cairn/optimize/disparity_calibration.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"
#include "cairn/slam/slam.h"

namespace cairn {

/// Holds a run of SLAM that finds nothing more to correct in its stereo pairs, and what was found before. Of
/// RGB-D, it is the run alone.
struct SettledRun {
  Sequence sequence;  ///< with the correction that was stated and what was found in addition
  SlamResult slam;
  SlamOptions options;  ///< of the run
  RowErrors rows;       ///< what the stated correction leaves
  bool rows_applied = false;
  /// What the stated correction leaves; `applied` says whether the sequence's correction has it.
  DisparityCalibration disparities;
  /// Standard deviation of the field that is left after the last run, pixels: the formal one, half of what
  /// both halves of the keyframes differ by, or 0.02, whichever is most: in simulated pairs without an error
  /// fields of 0.005 to 0.04 were found, because the matching of windows has a bias. 0 if none was found.
  double field_sigma_px = 0;
};

/// Measures the rows of the pairs, corrects them if that matters, and runs SLAM until it finds no further
/// field of disparities that matters, at most four times, because which matches a run keeps depends on the
/// field. Throws InputError as run_slam does.
[[nodiscard]] SettledRun run_until_settled(const Sequence& recorded, const SlamOptions& options,
                                           const Executor& executor, Progress& progress);

/// Returns the camera's poses from which the scale of motions is best seen: where a field of disparities was
/// found but is too small to be corrected, those of another run without it, as it may still change lengths by
/// some tenths of a percent, unless it is not even three of its standard deviations.
[[nodiscard]] Trajectory motions_for_scale(const SettledRun& run, const Executor& executor,
                                           Progress& progress);

/// Computes the standard deviation of the scale of all motions by that of the field of disparities. 0 for
/// RGB-D.
[[nodiscard]] double scale_sigma_by_disparities(const SettledRun& run);

/// Returns the terms of rows and disparities as quantities; none for RGB-D.
[[nodiscard]] std::vector<Quantity> quantities_of(const SettledRun& run);

}  // namespace cairn
