// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/evaluate/drift.h"
#include "cairn/evaluate/error_statistics.h"
#include "cairn/evaluate/pose_errors.h"
#include "cairn/geometry/alignment.h"

namespace cairn {

/// Names how the estimate is aligned to the reference.
enum class AlignmentMode {
  none,  ///< not at all: both are in one world already
  se3,   ///< rotated and translated
  sim3,  ///< rotated, translated and scaled: for a monocular estimate
};

/// Sets the alignment and the measures of evaluate_trajectory.
struct EvaluationOptions {
  /// Alignment under which the errors of each pose, RPE and drift are measured; the ATE is reported under
  /// each.
  AlignmentMode alignment = AlignmentMode::se3;
  double max_gap_s = 0.02;  ///< largest difference of the stamps of a pair, as the TUM tools
  std::vector<RpeOptions> rpe = {
      {1, RpeUnit::frames, false}, {1, RpeUnit::metres, false}, {1, RpeUnit::seconds, false}};
  DriftOptions drift;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Says if a trajectory was evaluated and, if not, why.
enum class EvaluationStatus {
  ok,
  no_pairs,      ///< no two stamps are within max_gap_s
  not_alignable  ///< see TrajectoryEvaluation::absolute; there are no errors
};

/// Holds the absolute errors that remain after an alignment.
struct AbsoluteErrors {
  AlignmentStatus status = AlignmentStatus::ok;
  Similarity3 reference_from_estimate;     ///< the alignment, between the two worlds
  double turn_uncertainty = 0;             ///< see Alignment; 0 if nothing was aligned
  std::optional<ErrorStatistics> ate_m;    ///< nullopt if there is no alignment
  std::optional<ErrorStatistics> ate_deg;  ///< nullopt if there is no alignment
};

/// Holds the relative errors for one interval.
struct RelativeErrors {
  RpeOptions options;
  std::optional<ErrorStatistics> rpe_m;  ///< nullopt if no interval is as long as the delta
  std::optional<ErrorStatistics> rpe_deg;
};

/// Holds the result of evaluate_trajectory.
struct TrajectoryEvaluation {
  EvaluationStatus status = EvaluationStatus::no_pairs;
  std::vector<PosePair> pairs;           ///< estimates aligned as the options say if status is ok
  PoseErrors errors;                     ///< absolute, for each pair
  AbsoluteErrors absolute;               ///< after the alignment that the options name
  AbsoluteErrors se3, sim3;              ///< after these alignments, whatever the options say
  std::vector<RelativeErrors> relative;  ///< for each of EvaluationOptions::rpe
  std::optional<Drift> drift;            ///< nullopt for short paths
};

/// Pairs the poses by time, aligns the estimate to the reference by its camera centres, and measures absolute
/// and relative errors. The definitions are evo's (`evo_ape`, `evo_rpe` with -a or -as) and, apart from
/// rounding, so are the figures; the drift is KITTI's. Throws PreconditionError if an option is out of range
/// or a pose is not finite.
[[nodiscard]] TrajectoryEvaluation evaluate_trajectory(const Trajectory& estimate,
                                                       const Trajectory& reference,
                                                       const EvaluationOptions& options = {});

}  // namespace cairn
