// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/evaluate/landmark_consistency.h"

namespace cairn::app {

/// What cairn evaluate --landmarks is given.
struct EvaluateLandmarksArguments {
  std::string map, reference, camera;  ///< paths; camera as --camera has it
  LandmarkEvaluationOptions options;
  std::string plot_coverage;  ///< SVG file; empty: none
  bool json = false;
  int threads = 1;
};

/// Compares the landmarks of a map with a simulated world and prints what it finds. Returns the exit code.
[[nodiscard]] int evaluate_map(const EvaluateLandmarksArguments& arguments);

}  // namespace cairn::app
