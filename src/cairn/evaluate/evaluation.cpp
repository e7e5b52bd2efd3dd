// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/evaluation.h"

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

bool is_finite(const Trajectory& trajectory) {
  return std::all_of(trajectory.begin(), trajectory.end(), [](const StampedPose& pose) {
    return pose.world_from_camera.translation.allFinite() &&
           pose.world_from_camera.rotation.coeffs().allFinite();
  });
}

AbsoluteErrors align(AlignmentMode mode, std::span<const PosePair> pairs) {
  if (mode == AlignmentMode::none) return {};
  const Alignment alignment = align_pairs(pairs, mode == AlignmentMode::sim3);
  return {alignment.status, alignment.target_from_source, alignment.turn_uncertainty, {}, {}};
}

void summarize(const PoseErrors& errors, AbsoluteErrors& absolute) {
  absolute.ate_m = summarize_errors(errors.translation_m);
  absolute.ate_deg = summarize_errors(errors.rotation_deg);
}

AbsoluteErrors aligned_errors(AlignmentMode mode, std::span<const PosePair> pairs) {
  AbsoluteErrors absolute = align(mode, pairs);
  if (absolute.status == AlignmentStatus::ok)
    summarize(absolute_errors(aligned_pairs(absolute.reference_from_estimate, pairs)), absolute);
  return absolute;
}

RelativeErrors measure_rpe(std::span<const PosePair> pairs, const RpeOptions& options) {
  const PoseErrors errors = relative_errors(pairs, rpe_intervals(pairs, options));
  return {options, summarize_errors(errors.translation_m), summarize_errors(errors.rotation_deg)};
}

}  // namespace

void EvaluationOptions::validate() const {
  require(max_gap_s >= 0, "max_gap_s is not below 0");
  for (const auto& options : rpe) options.validate();
  drift.validate();
}

TrajectoryEvaluation evaluate_trajectory(const Trajectory& estimate, const Trajectory& reference,
                                         const EvaluationOptions& options) {
  options.validate();
  require(is_finite(estimate) && is_finite(reference), "poses to evaluate are finite");
  TrajectoryEvaluation evaluation;
  evaluation.pairs = pair_poses(estimate, reference, options.max_gap_s);
  if (evaluation.pairs.empty()) return evaluation;
  evaluation.se3 = aligned_errors(AlignmentMode::se3, evaluation.pairs);
  evaluation.sim3 = aligned_errors(AlignmentMode::sim3, evaluation.pairs);
  evaluation.absolute = align(options.alignment, evaluation.pairs);
  if (evaluation.absolute.status != AlignmentStatus::ok) {
    evaluation.status = EvaluationStatus::not_alignable;
    return evaluation;
  }
  evaluation.status = EvaluationStatus::ok;
  evaluation.pairs = aligned_pairs(evaluation.absolute.reference_from_estimate, evaluation.pairs);
  evaluation.errors = absolute_errors(evaluation.pairs);
  summarize(evaluation.errors, evaluation.absolute);
  for (const auto& rpe : options.rpe) evaluation.relative.push_back(measure_rpe(evaluation.pairs, rpe));
  evaluation.drift = measure_drift(evaluation.pairs, options.drift);
  return evaluation;
}

}  // namespace cairn
