// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/evaluation.h"

#include "cairn/core/error.h"

namespace cairn {
namespace {

Alignment align_pairs(const std::vector<PosePair>& pairs, bool with_scale) {
  std::vector<Eigen::Vector3d> estimated, true_centres;
  for (const auto& pair : pairs) {
    estimated.push_back(pair.estimate.translation);
    true_centres.push_back(pair.reference.translation);
  }
  return align_points(estimated, true_centres, with_scale);
}

/// False where the poses do not determine the alignment.
bool align(AlignmentMode mode, TrajectoryEvaluation& evaluation) {
  if (mode == AlignmentMode::none) return true;
  const Alignment alignment = align_pairs(evaluation.pairs, mode == AlignmentMode::sim3);
  evaluation.alignment_status = alignment.status;
  if (alignment.status != AlignmentStatus::ok) return false;
  evaluation.reference_from_estimate = alignment.target_from_source;
  for (auto& pair : evaluation.pairs) pair.estimate = alignment.target_from_source * pair.estimate;
  return true;
}

}  // namespace

void EvaluationOptions::validate() const {
  require(max_gap_s >= 0, "max_gap_s is not below 0");
  rpe.validate();
}

TrajectoryEvaluation evaluate_trajectory(const Trajectory& estimate, const Trajectory& reference,
                                         const EvaluationOptions& options) {
  options.validate();
  TrajectoryEvaluation evaluation;
  evaluation.pairs = pair_poses(estimate, reference, options.max_gap_s);
  if (evaluation.pairs.empty()) return evaluation;
  evaluation.status = EvaluationStatus::not_alignable;
  if (!align(options.alignment, evaluation)) return evaluation;
  evaluation.status = EvaluationStatus::ok;
  evaluation.absolute = absolute_errors(evaluation.pairs);
  evaluation.ate_m = summarize_errors(evaluation.absolute.translation_m);
  evaluation.ate_deg = summarize_errors(evaluation.absolute.rotation_deg);
  const PoseErrors relative = relative_errors(evaluation.pairs, rpe_intervals(evaluation.pairs, options.rpe));
  evaluation.rpe_m = summarize_errors(relative.translation_m);
  evaluation.rpe_deg = summarize_errors(relative.rotation_deg);
  return evaluation;
}

}  // namespace cairn
