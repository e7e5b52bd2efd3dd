// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/evaluate/evaluation.h"
#include "cairn/evaluate/pose_consistency.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Holds an estimate and how far it is from the reference.
struct EvaluatedTrajectory {
  std::string path;  ///< as it was given; its last two parts are its name
  Trajectory estimate;
  TrajectoryEvaluation result;
  std::vector<StatedPoses> covariances = {};  ///< what its run states of its poses; empty for nothing
};

/// Holds what is told of estimates that were compared with one reference.
struct EvaluationReport {
  std::string reference_path;
  Trajectory reference;
  EvaluationOptions options;  ///< of all the estimates; `rpe` is not empty and all_pairs the same in it
  RpeUnit rpe_unit = RpeUnit::frames;     ///< of the RPE that stands apart in JSON: the first in this unit
  bool has_times = true;                  ///< false: poses were paired by their order
  std::vector<PoseTolerance> tolerances;  ///< for each: how many poses are within
  std::optional<std::int64_t> queries;    ///< images that were looked for; shares of them are told
  std::vector<EvaluatedTrajectory> estimates;  ///< at least one
};

/// Holds the percentiles that are told of errors.
inline constexpr double kPercents[] = {50, 90, 95, 99};

/// Returns the figures of one estimate, or a table with a row for each of several; then the percentiles of
/// the errors, the shares of poses within the tolerances, and whether stated covariances hold. Lengths are in
/// centimetres, or in metres if the largest error is 10 m or more. A single estimate must have been aligned
/// (EvaluationStatus::ok).
[[nodiscard]] std::string format_evaluation_text(const EvaluationReport& report);

/// Returns a JSON object with all figures in full, or {"estimates": [...]} of several estimates. Metres,
/// degrees, seconds, as the keys say; an estimate without alignment has its status and its counts only.
[[nodiscard]] std::string format_evaluation_json(const EvaluationReport& report);

/// Draws the estimates that were aligned, an SVG file: trajectories from three sides and errors over time.
/// At least one is.
[[nodiscard]] std::string draw_evaluation(const EvaluationReport& report);

/// Draws whether the stated covariances hold, an SVG file: a panel for each set of them, with curves of the
/// whole pose, its position and its rotation. At least one estimate states covariances of poses that pair.
[[nodiscard]] std::string draw_coverage(const EvaluationReport& report);

}  // namespace cairn
