// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "commands.h"
#include "compared_trajectories.h"
#include "evaluate_output.h"

namespace cairn::app {
namespace {

const std::map<std::string, AlignmentMode> kAlignments = {
    {"se3", AlignmentMode::se3}, {"sim3", AlignmentMode::sim3}, {"none", AlignmentMode::none}};
constexpr RpeUnit kUnits[] = {RpeUnit::frames, RpeUnit::metres, RpeUnit::seconds};

/// CLI11 gives all names to a first positional of any number, so that REF is split off here.
class UsageOfTrajectories : public CLI::Formatter {
  std::string make_option_usage(const CLI::Option*) const override { return "EST... REF"; }
};

void declare_trajectories(CLI::App& app, EvaluateArguments& arguments) {
  app.add_option(
         "EST", arguments.estimates,
         "EST: trajectory files (TUM, KITTI, EuRoC, OXTS packets or a table, docs/poses.md), or folders of "
         "runs; REF, the last: the truth, such a file, or a sequence's folder that carries it")
      ->required()
      ->option_text("... REF");
  app.formatter(std::make_shared<UsageOfTrajectories>());
  app.callback([&arguments] {
    if (arguments.estimates.size() < 2) throw CLI::RequiredError("REF");
    arguments.reference = arguments.estimates.back();
    arguments.estimates.pop_back();
  });
}

void declare_rpe(CLI::App& app, EvaluateArguments& arguments) {
  app.add_option("--rpe-delta", arguments.rpe_deltas,
                 "lengths of the RPE's intervals in --rpe-unit; in the other units they stay at 1")
      ->check(number_in(1e-6, 1e6))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("N[,N...]")
      ->capture_default_str();
  app.add_option("--rpe-unit", arguments.rpe_unit, "unit of --rpe-delta: frames, metres (of path), seconds")
      ->check(CLI::IsMember({"frames", "metres", "seconds"}))
      ->capture_default_str();
  app.add_flag("--rpe-all-pairs", arguments.rpe_all_pairs,
               "an interval from each pose, not from where the last one ended");
}

void declare(CLI::App& app, EvaluateArguments& arguments) {
  declare_trajectories(app, arguments);
  app.add_option("--align", arguments.align,
                 "how EST is moved onto REF: se3 turns and moves, sim3 scales as well, none")
      ->check(CLI::IsMember({"se3", "sim3", "none"}))
      ->capture_default_str();
  app.add_option("--max-gap", arguments.options.max_gap_s, "between the stamps of a pair, seconds")
      ->check(number_in(0, 10))
      ->type_name("S")
      ->capture_default_str();
  add_stamp_offset(app, "--offset", "EST", arguments.offset);
  declare_rpe(app, arguments);
  app.add_option("--camera", arguments.camera,
                 "camera.yaml, or tum-fr1, tum-fr2, tum-fr3, where REF is a sequence without calibration")
      ->type_name("FILE|NAME");
  app.add_option("--plot", arguments.plot,
                 "picture of the trajectories from three sides and of errors over time")
      ->type_name("OUT.svg");
  add_common_options(app, arguments.common, {.quiet = false});
  app.footer(
      "Examples: cairn evaluate run/ recording/ --plot trajectory.svg\n"
      "          cairn evaluate run1/ run2/ other.txt recording/     a row for each\n"
      "ATE and RPE are those of evo and the TUM tools, drift is KITTI's. The ATE is given by se3 and sim3, "
      "all else\n"
      "by --align. Exit code 1: nothing to compare for an EST.");
}

/// Each unit with a delta of 1, that of --rpe-unit with those of --rpe-delta.
std::vector<RpeOptions> rpe_options(const EvaluateArguments& arguments) {
  std::vector<RpeOptions> options;
  for (const RpeUnit unit : kUnits) {
    const bool chosen = name_of(unit) == arguments.rpe_unit;
    for (const double delta : chosen ? arguments.rpe_deltas : std::vector<double>{1})
      options.push_back({delta, unit, arguments.rpe_all_pairs});
  }
  return options;
}

void check(EvaluateArguments& arguments) {
  for (const double delta : arguments.rpe_deltas) {
    if (arguments.rpe_unit != "frames" || (delta >= 1 && delta == std::floor(delta))) continue;
    throw InputError({"--rpe-delta", 0, "a whole number of frames", fmt::format("{}", delta),
                      "For other units add --rpe-unit metres or --rpe-unit seconds."});
  }
  arguments.options.alignment = kAlignments.at(arguments.align);
  arguments.options.rpe = rpe_options(arguments);
}

/// Where no file says a time there are no intervals in seconds.
void leave_out_times(EvaluateArguments& arguments) {
  arguments.has_times = false;
  std::erase_if(arguments.options.rpe, [](const RpeOptions& rpe) { return rpe.unit == RpeUnit::seconds; });
  if (arguments.rpe_unit != "seconds") return;
  throw InputError({"--rpe-unit", 0, "frames or metres, as no file has time stamps", "seconds",
                    "Choose another unit, or give one of the trajectories with time stamps."});
}

Evaluations evaluate(const EvaluateArguments& arguments, const ComparedTrajectories& compared) {
  Evaluations evaluations{arguments, compared.reference, {}, compared.start_offsets_ns};
  for (std::size_t i = 0; i < compared.estimates.size(); ++i)
    evaluations.estimates.push_back({arguments.estimates[i], compared.estimates[i], {}});
  for (auto& [path, estimate, result] : evaluations.estimates)
    result = evaluate_trajectory(estimate, compared.reference, arguments.options);
  return evaluations;
}

}  // namespace

int run_evaluate(int argc, char** argv) {
  EvaluateArguments arguments;
  CLI::App app("How far trajectories are from the truth: ATE, RPE and drift.", "evaluate");
  declare(app, arguments);
  if (const auto code = parse(app, argc, argv)) return *code;
  check(arguments);
  const ComparedTrajectories compared =
      read_compared({arguments.estimates, arguments.reference, arguments.camera, arguments.offset});
  if (!compared.has_times) leave_out_times(arguments);
  const Evaluations evaluations = evaluate(arguments, compared);
  for (const auto& evaluated : evaluations.estimates) print_doubts(evaluations, evaluated);
  const auto failed = std::count_if(evaluations.estimates.begin(), evaluations.estimates.end(),
                                    [](const auto& e) { return e.result.status != EvaluationStatus::ok; });
  const bool any = failed < std::ssize(evaluations.estimates);
  if (any && !arguments.plot.empty()) write_file(arguments.plot, draw_evaluations(evaluations));
  if (arguments.common.json) {
    print_evaluations_json(evaluations);
  } else if (any) {
    print_evaluations(evaluations);
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace cairn::app
