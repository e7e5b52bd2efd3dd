// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/evaluate/drift.h"
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
  /// Under which the errors of each pose, RPE and drift are taken; the ATE is reported under each.
  AlignmentMode alignment = AlignmentMode::se3;
  double max_gap_s = 0.02;  ///< between stamps of a pair, as the TUM tools
  std::vector<RpeOptions> rpe = {
      {1, RpeUnit::frames, false}, {1, RpeUnit::metres, false}, {1, RpeUnit::seconds, false}};
  DriftOptions drift;

  void validate() const;
};

enum class EvaluationStatus {
  ok,
  no_pairs,      ///< no two stamps are within max_gap_s
  not_alignable  ///< see TrajectoryEvaluation::absolute; errors are left out
};

/// What an alignment leaves of the absolute errors.
struct AbsoluteErrors {
  AlignmentStatus status = AlignmentStatus::ok;
  Similarity3 reference_from_estimate;   ///< the alignment, between the two worlds
  double turn_uncertainty = 0;           ///< see Alignment; 0 where nothing was aligned
  std::optional<ErrorStatistics> ate_m;  ///< nothing where there is no alignment
  std::optional<ErrorStatistics> ate_deg;
};

struct RelativeErrors {
  RpeOptions options;
  std::optional<ErrorStatistics> rpe_m;  ///< nothing where no interval is as long as the delta
  std::optional<ErrorStatistics> rpe_deg;
};

struct TrajectoryEvaluation {
  EvaluationStatus status = EvaluationStatus::no_pairs;
  std::vector<PosePair> pairs;           ///< estimates aligned as the options say, where status is ok
  PoseErrors errors;                     ///< absolute, for each pair
  AbsoluteErrors absolute;               ///< aligned as the options say
  AbsoluteErrors se3, sim3;              ///< aligned one way and the other, whatever the options say
  std::vector<RelativeErrors> relative;  ///< for each of EvaluationOptions::rpe
  std::optional<Drift> drift;            ///< nothing for short paths
};

/// Pairs the poses by time, aligns the estimate to the reference by its camera centres, and measures absolute
/// and relative errors. The definitions are evo's (`evo_ape`, `evo_rpe` with -a or -as) and, but for
/// rounding, so are the figures; the drift is KITTI's. PreconditionError for coordinates that are not finite.
[[nodiscard]] TrajectoryEvaluation evaluate_trajectory(const Trajectory& estimate,
                                                       const Trajectory& reference,
                                                       const EvaluationOptions& options = {});

}  // namespace cairn
