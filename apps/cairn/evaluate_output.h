// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/evaluate/evaluation.h"
#include "common.h"

namespace cairn::app {

struct EvaluateArguments {
  CommonOptions common;
  std::string estimate, reference, camera, align = "se3", rpe_unit = "frames", plot;
  EvaluationOptions options;
};

/// An evaluation with what it is of.
struct Evaluated {
  const EvaluateArguments& arguments;
  const Trajectory& estimate;
  const Trajectory& reference;
  const TrajectoryEvaluation& result;
};

/// The table on stdout.
void print_evaluation(const Evaluated& evaluated);
/// One object on stdout, all figures in full.
void print_evaluation_json(const Evaluated& evaluated);
/// On stderr: why there is nothing to compare and what to do. Returns the exit code, 1.
int print_failure(const Evaluated& evaluated);
/// The picture of --plot, an SVG file.
[[nodiscard]] std::string draw_evaluation(const Evaluated& evaluated);

}  // namespace cairn::app
