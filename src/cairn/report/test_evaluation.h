// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/report/evaluation_report.h"

namespace cairn {

/// Five poses a metre and a second apart; the estimate has the first four, 1 to 4 cm and degrees wrong.
inline EvaluationReport small_evaluation() {
  EvaluationReport report;
  report.reference_path = "data/room/groundtruth.txt";
  report.options.rpe = {{1, RpeUnit::frames, false}, {2.5, RpeUnit::metres, false}};
  EvaluatedTrajectory evaluated{"out/run/trajectory.txt", {}, {}};
  TrajectoryEvaluation& result = evaluated.result;
  result.status = EvaluationStatus::ok;
  for (int i = 0; i < 5; ++i) {
    const Rigid3 pose{Eigen::Quaterniond::Identity(), {1.0 * i, 0, 0}};
    const std::int64_t stamp_ns = 1'000'000'000LL * i;
    report.reference.push_back({stamp_ns, WorldFromCamera(pose)});
    if (i == 4) break;
    evaluated.estimate.push_back({stamp_ns, WorldFromCamera(pose)});
    result.pairs.push_back({stamp_ns, pose, pose});
    result.errors.translation_m.push_back(0.01 * (i + 1));
    result.errors.rotation_deg.push_back(i + 1);
  }
  result.absolute.ate_m = ErrorStatistics{4, 0.0275, 0.025, 0.024, 0.011, 0.01, 0.04};
  result.absolute.ate_deg = ErrorStatistics{4, 2.75, 2.5, 2.4, 1.1, 1, 4};
  result.absolute.reference_from_estimate.translation = {3, 4, 0};
  result.absolute.turn_uncertainty = 0.25;
  result.se3 = result.sim3 = result.absolute;
  result.sim3.ate_m->rmse = 0.0125;
  result.sim3.reference_from_estimate.scale = 1.0625;
  result.relative = {{report.options.rpe[0], ErrorStatistics{3, 0.5, 0.4, 0.3, 0.2, 0.1, 0.6},
                      ErrorStatistics{3, 5, 4, 3, 2, 1, 6}},
                     {report.options.rpe[1], std::nullopt, std::nullopt}};
  report.estimates = {evaluated};
  return report;
}

/// The same with a second estimate of which no pose is near one of the reference.
inline EvaluationReport two_evaluations() {
  EvaluationReport report = small_evaluation();
  report.estimates.push_back({"other.txt", {{99'000'000'000, {}}}, {}});
  return report;
}

}  // namespace cairn
