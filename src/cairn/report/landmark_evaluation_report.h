// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/evaluate/landmark_consistency.h"

namespace cairn {

/// Holds what is told of the landmarks of a map that was compared with a simulated world.
struct LandmarkEvaluationReport {
  std::string map_path, reference_path;  ///< as they were given
  LandmarkEvaluationOptions options;
  LandmarkEvaluation result;  ///< its alignment_status is ok
};

/// Returns the numbers of landmarks, their distances from the true surfaces, and whether their covariances
/// hold: of all, on one surface, at edges, by the distance from the nearest camera and by the number of
/// observations.
[[nodiscard]] std::string format_landmark_evaluation_text(const LandmarkEvaluationReport& report);

/// Returns a JSON object with all figures in full; metres and degrees, as the keys say.
[[nodiscard]] std::string format_landmark_evaluation_json(const LandmarkEvaluationReport& report);

/// Draws whether the covariances hold, an SVG file. A landmark was judged.
[[nodiscard]] std::string draw_landmark_coverage(const LandmarkEvaluationReport& report);

}  // namespace cairn
