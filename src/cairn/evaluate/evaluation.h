// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/evaluate/error_statistics.h"
#include "cairn/evaluate/pose_errors.h"
#include "cairn/geometry/alignment.h"

namespace cairn {

enum class AlignmentMode {
  none,  ///< both are in one world already
  se3,   ///< turned and moved
  sim3,  ///< scaled as well: for a monocular estimate
};

struct EvaluationOptions {
  AlignmentMode alignment = AlignmentMode::se3;
  double max_gap_s = 0.02;  ///< between stamps of a pair, as the TUM tools
  RpeOptions rpe;

  void validate() const;
};

enum class EvaluationStatus {
  ok,
  no_pairs,      ///< no two stamps are within max_gap_s
  not_alignable  ///< see alignment_status; errors are left out
};

struct TrajectoryEvaluation {
  EvaluationStatus status = EvaluationStatus::no_pairs;
  AlignmentStatus alignment_status = AlignmentStatus::ok;
  Similarity3 reference_from_estimate;  ///< the alignment, between the two worlds
  std::vector<PosePair> pairs;          ///< estimates aligned, where status is ok
  PoseErrors absolute;                  ///< for each pair
  std::optional<ErrorStatistics> ate_m;
  std::optional<ErrorStatistics> ate_deg;
  std::optional<ErrorStatistics> rpe_m;  ///< nothing where no interval is as long as RpeOptions::delta
  std::optional<ErrorStatistics> rpe_deg;
};

/// Pairs the poses by time, aligns the estimate to the reference by its camera centres, and measures absolute
/// and relative errors. The definitions are evo's (`evo_ape`, `evo_rpe` with -a or -as) and, but for
/// rounding, so are the figures.
[[nodiscard]] TrajectoryEvaluation evaluate_trajectory(const Trajectory& estimate,
                                                       const Trajectory& reference,
                                                       const EvaluationOptions& options = {});

}  // namespace cairn
