// SPDX-License-Identifier: Apache-2.0
#include "evaluate_landmarks.h"

#include <fmt/format.h>

#include <cstdio>

#include "cairn/core/executor.h"
#include "cairn/core/file.h"
#include "cairn/report/landmark_evaluation_report.h"
#include "cairn/report/trajectory_words.h"
#include "cairn/sequence/sequence.h"
#include "common.h"

namespace cairn::app {

int evaluate_map(const EvaluateLandmarksArguments& arguments) {
  SequenceOptions options;
  options.camera = arguments.camera;
  const Sequence sequence = open_sequence(arguments.reference, options);
  print_warnings(sequence.report.warnings);
  const Executor executor(arguments.threads);
  const LandmarkEvaluationReport report{
      arguments.map, arguments.reference, arguments.options,
      evaluate_landmarks(arguments.map, sequence, arguments.options, executor)};
  const LandmarkEvaluation& result = report.result;
  const bool is_aligned = result.alignment_status == AlignmentStatus::ok;
  if (!is_aligned) {
    fmt::print(stderr, "cairn: no alignment by {} from {} keyframes: {}.\n  Compare without: --align none.\n",
               name_of(arguments.options.alignment), result.keyframe_pairs, explain(result.alignment_status));
  } else if (!result.all) {
    fmt::print(stderr, "cairn: no landmark can be judged.\n");
  }
  if (result.all && !arguments.plot_coverage.empty())
    write_file(arguments.plot_coverage, draw_landmark_coverage(report));
  if (arguments.json) {
    fmt::print("{}", format_landmark_evaluation_json(report));
  } else if (is_aligned) {
    fmt::print("{}", format_landmark_evaluation_text(report));
  }
  return result.all ? 0 : 1;
}

}  // namespace cairn::app
