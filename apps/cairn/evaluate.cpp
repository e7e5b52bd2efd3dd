// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "commands.h"
#include "evaluate_output.h"

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, AlignmentMode> kAlignments = {
    {"se3", AlignmentMode::se3}, {"sim3", AlignmentMode::sim3}, {"none", AlignmentMode::none}};
const std::map<std::string, RpeUnit> kUnits = {
    {"frames", RpeUnit::frames}, {"metres", RpeUnit::metres}, {"seconds", RpeUnit::seconds}};

void declare(CLI::App& app, EvaluateArguments& arguments) {
  app.add_option("EST", arguments.estimate, "trajectory file (TUM format), or a run's folder")->required();
  app.add_option("REF", arguments.reference,
                 "the truth: trajectory file, or a sequence's folder that carries it")
      ->required();
  app.add_option("--align", arguments.align,
                 "how EST is moved onto REF: se3 turns and moves, sim3 scales as well, none")
      ->check(CLI::IsMember({"se3", "sim3", "none"}))
      ->capture_default_str();
  app.add_option("--max-gap", arguments.options.max_gap_s, "between the stamps of a pair, seconds")
      ->check(CLI::Range(0.0, 10.0))
      ->type_name("S")
      ->capture_default_str();
  app.add_option("--rpe-delta", arguments.options.rpe.delta, "length of the intervals of the RPE")
      ->check(CLI::Range(1e-6, 1e6))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--rpe-unit", arguments.rpe_unit, "unit of --rpe-delta: frames, metres (of path), seconds")
      ->check(CLI::IsMember({"frames", "metres", "seconds"}))
      ->capture_default_str();
  app.add_flag("--rpe-all-pairs", arguments.options.rpe.all_pairs,
               "an interval from each pose, not from where the last one ended");
  app.add_option("--camera", arguments.camera,
                 "camera.yaml, or tum-fr1, tum-fr2, tum-fr3, where REF is a sequence without calibration")
      ->type_name("FILE|NAME");
  app.add_option("--plot", arguments.plot, "picture of both trajectories from above")->type_name("OUT.svg");
  add_common_options(app, arguments.common, {.quiet = false});
  app.footer(
      "Example: cairn evaluate run/ recording/ --plot trajectory.svg\n"
      "ATE and RPE are those of evo and the TUM tools. Exit code 1: nothing to compare.");
}

void check(EvaluateArguments& arguments) {
  arguments.options.alignment = kAlignments.at(arguments.align);
  RpeOptions& rpe = arguments.options.rpe;
  rpe.unit = kUnits.at(arguments.rpe_unit);
  if (rpe.unit == RpeUnit::frames && (rpe.delta < 1 || rpe.delta != std::floor(rpe.delta))) {
    throw InputError({"--rpe-delta", 0, "a whole number of frames", fmt::format("{}", rpe.delta),
                      "For other units add --rpe-unit metres or --rpe-unit seconds."});
  }
}

/// A trajectory file, or the one of a run.
Trajectory read_estimate(const fs::path& path) {
  if (!fs::is_directory(path)) return read_tum_trajectory(path);
  const fs::path inside = path / "trajectory.txt";
  if (fs::exists(inside)) return read_tum_trajectory(inside);
  throw InputError({path.string(), 0, "a trajectory file, or a run's folder with trajectory.txt",
                    "a folder without one", "Name the file that holds the trajectory."});
}

/// A trajectory file, the one of a run, or a sequence's truth.
Trajectory read_reference(const EvaluateArguments& arguments) {
  const fs::path path = arguments.reference;
  if (!fs::is_directory(path) || fs::exists(path / "run.json")) return read_estimate(path);
  SequenceOptions options;
  options.camera = arguments.camera;
  const Sequence sequence = open_sequence(path, options);
  if (sequence.truth && !sequence.truth->empty()) return *sequence.truth;
  throw InputError({path.string(), 0, "a sequence with true poses", fmt::format("none ({})", sequence.format),
                    "Name a trajectory file as REF."});
}

}  // namespace

int run_evaluate(int argc, char** argv) {
  EvaluateArguments arguments;
  CLI::App app("How far a trajectory is from the truth: ATE and RPE.", "evaluate");
  declare(app, arguments);
  if (const auto code = parse(app, argc, argv)) return *code;
  check(arguments);
  const Trajectory estimate = read_estimate(arguments.estimate);
  const Trajectory reference = read_reference(arguments);
  const TrajectoryEvaluation result = evaluate_trajectory(estimate, reference, arguments.options);
  const Evaluated evaluated{arguments, estimate, reference, result};
  if (result.status != EvaluationStatus::ok) return print_failure(evaluated);
  if (!arguments.plot.empty()) write_file(arguments.plot, draw_evaluation(evaluated));
  arguments.common.json ? print_evaluation_json(evaluated) : print_evaluation(evaluated);
  return 0;
}

}  // namespace cairn::app
