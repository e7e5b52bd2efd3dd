// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/evaluate/evaluation.h"
#include "cairn/report/evaluation_report.h"
#include "cairn/report/trajectory_words.h"
#include "camera_argument.h"
#include "commands.h"
#include "common.h"
#include "compared_trajectories.h"
#include "evaluate_covariances.h"
#include "evaluate_landmarks.h"
#include "pose_arguments.h"
#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

struct EvaluateArguments {
  CommonOptions common;
  std::vector<std::string> estimates;
  std::vector<std::string> within;  ///< --within M,DEG
  std::vector<PoseTolerance> tolerances;
  std::optional<std::int64_t> queries;
  std::string reference, camera, align = "se3", rpe_unit = "frames", plot, plot_coverage;
  bool landmarks = false;
  StampOffset offset;                    ///< added to the estimates' stamps
  std::vector<double> rpe_deltas = {1};  ///< in rpe_unit
  bool rpe_all_pairs = false;
  EvaluationOptions options;
};

const std::map<std::string, AlignmentMode> kAlignments = {
    {"se3", AlignmentMode::se3}, {"sim3", AlignmentMode::sim3}, {"none", AlignmentMode::none}};
constexpr RpeUnit kUnits[] = {RpeUnit::frames, RpeUnit::metres, RpeUnit::seconds};

void declare_trajectories(CommandLine& app, EvaluateArguments& arguments) {
  app.add_option(
         "EST", arguments.estimates,
         "EST: trajectory files (TUM, KITTI, EuRoC, OXTS packets or a table, docs/poses.md), or folders of "
         "runs, with --landmarks one map; REF, the last: the truth, such a file, or a sequence's folder that "
         "carries it")
      .required()
      .help_text("... REF");
  app.split_last(arguments.estimates, arguments.reference, "REF", "EST... REF");
}

void declare_within(CommandLine& app, EvaluateArguments& arguments) {
  app.add_option("--within", arguments.within,
                 "how many poses are off by at most so many metres and degrees; may be repeated")
      .type_name("M,DEG");
  app.add_option("--queries", arguments.queries,
                 "images that were to be localised: --within is given as a share of them, too")
      .check(number_in(1, 1e9))
      .type_name("N");
}

void declare_rpe(CommandLine& app, EvaluateArguments& arguments) {
  app.add_option("--rpe-delta", arguments.rpe_deltas,
                 "lengths of the RPE's intervals in --rpe-unit; in the other units they stay at 1")
      .check(number_in(1e-6, 1e6))
      .delimiter(',')
      .type_name("N[,N...]")
      .show_default();
  app.add_option("--rpe-unit", arguments.rpe_unit, "unit of --rpe-delta: frames, metres (of path), seconds")
      .check(one_of({"frames", "metres", "seconds"}))
      .show_default();
  app.add_flag("--rpe-all-pairs", arguments.rpe_all_pairs,
               "an interval from each pose, not from where the last one ended");
}

void declare_coverage(CommandLine& app, EvaluateArguments& arguments) {
  app.add_option("--plot-coverage", arguments.plot_coverage,
                 "picture of stated covariances: expected against observed shares of errors inside")
      .check(FileEnding{".svg"})
      .type_name("OUT.svg");
  app.add_flag("--landmarks", arguments.landmarks,
               "EST is a map, REF its simulated sequence (--depth-truth): the landmarks' distances from the "
               "true surfaces against their covariances");
}

void declare(CommandLine& app, EvaluateArguments& arguments) {
  declare_trajectories(app, arguments);
  app.add_option(
         "--align", arguments.align,
         "how EST is moved onto REF: se3 turns and moves, sim3 scales as well, none; with --landmarks "
         "none, unless it is given")
      .check(one_of({"se3", "sim3", "none"}))
      .show_default();
  app.add_option("--max-gap", arguments.options.max_gap_s, "between the stamps of a pair, seconds")
      .check(number_in(0, 10))
      .type_name("S")
      .show_default();
  add_stamp_offset(app, "--offset", "EST", arguments.offset);
  declare_rpe(app, arguments);
  declare_within(app, arguments);
  app.add_option("--camera", arguments.camera,
                 "camera.yaml, or tum-fr1, tum-fr2, tum-fr3, where REF is a sequence without calibration")
      .type_name("FILE|NAME");
  app.add_option("--plot", arguments.plot,
                 "picture of the trajectories from three sides and of errors over time")
      .check(FileEnding{".svg"})
      .type_name("OUT.svg");
  declare_coverage(app, arguments);
  add_common_options(app, arguments.common, {.quiet = false});
  app.footer(
      "Examples: cairn evaluate run/ recording/ --plot trajectory.svg\n"
      "          cairn evaluate run1/ run2/ other.txt recording/     a row for each\n"
      "          cairn evaluate found/ recording/ --align none --within 0.05,5 --queries 200\n"
      "          cairn evaluate map/ street/ --landmarks --plot-coverage coverage.svg\n"
      "ATE and RPE are those of evo and the TUM tools, drift is KITTI's. The ATE is given by se3 and sim3, "
      "all else\n"
      "by --align. Covariances that a run states (localization.csv, keyframe_covariances.csv) are compared "
      "with the\n"
      "errors: NEES, and the shares of errors inside the ellipsoids of 50, 68, 95 and 99 %. Exit code 1: "
      "nothing to\n"
      "compare for an EST.");
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

PoseTolerance parse_tolerance(const std::string& text) {
  const auto numbers = parse_number_list(text, 2, "--within", "metres and degrees");
  if (numbers[0] > 0 && numbers[1] > 0) return {numbers[0], numbers[1]};
  throw InputError({"--within", 0, "metres and degrees above 0", fmt::format("'{}'", text),
                    "For example --within 0.05,5."});
}

void check(EvaluateArguments& arguments) {
  for (const std::string& text : arguments.within) arguments.tolerances.push_back(parse_tolerance(text));
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
  std::erase_if(arguments.options.rpe, [](const RpeOptions& rpe) { return rpe.unit == RpeUnit::seconds; });
  if (arguments.rpe_unit != "seconds") return;
  throw InputError({"--rpe-unit", 0, "frames or metres, as no file has time stamps", "seconds",
                    "Choose another unit, or give one of the trajectories with time stamps."});
}

void check_queries(const EvaluateArguments& arguments, const EvaluatedTrajectory& evaluated) {
  const std::int64_t poses = std::ssize(evaluated.estimate);
  if (!arguments.queries || *arguments.queries >= poses) return;
  throw InputError({"--queries", 0, fmt::format("at least {}, the poses of {}", poses, evaluated.path),
                    fmt::format("{}", *arguments.queries),
                    "Give the number of images that were looked for."});
}

RpeUnit rpe_unit(const EvaluateArguments& arguments) {
  return *std::find_if(std::begin(kUnits), std::end(kUnits),
                       [&](RpeUnit unit) { return name_of(unit) == arguments.rpe_unit; });
}

EvaluationReport evaluate(const EvaluateArguments& arguments, ComparedTrajectories compared) {
  EvaluationReport report{
      arguments.reference, std::move(compared.reference), arguments.options, rpe_unit(arguments),
      compared.has_times,  arguments.tolerances,          arguments.queries, {}};
  for (std::size_t i = 0; i < compared.estimates.size(); ++i) {
    TrajectoryEvaluation result =
        evaluate_trajectory(compared.estimates[i], report.reference, arguments.options);
    report.estimates.push_back({arguments.estimates[i], std::move(compared.estimates[i]), std::move(result)});
  }
  for (const EvaluatedTrajectory& evaluated : report.estimates) check_queries(arguments, evaluated);
  assess_covariances(compared, report);
  return report;
}

/// Throws InputError for an option that says nothing of landmarks.
void check_for_landmarks(const CommandLine& app, const EvaluateArguments& arguments) {
  for (const char* const option :
       {"--plot", "--within", "--queries", "--offset", "--rpe-delta", "--rpe-unit", "--rpe-all-pairs"})
    if (app.count(option) > 0)
      throw InputError({option, 0, "an option that has a meaning with --landmarks", "one of trajectories",
                        "Leave it out, or evaluate the trajectory in a command of its own."});
  if (arguments.estimates.size() == 1) return;
  throw InputError({"--landmarks", 0, "one map and its sequence",
                    fmt::format("{} maps", arguments.estimates.size()), "Evaluate one map after the other."});
}

EvaluateLandmarksArguments landmark_arguments(const CommandLine& app, const EvaluateArguments& arguments) {
  const AlignmentMode alignment =
      app.count("--align") > 0 ? kAlignments.at(arguments.align) : AlignmentMode::none;
  return {arguments.estimates.front(),
          arguments.reference,
          arguments.camera,
          {alignment, arguments.options.max_gap_s},
          arguments.plot_coverage,
          arguments.common.json,
          arguments.common.thread_count()};
}

void write_plots(const EvaluateArguments& arguments, const EvaluationReport& report) {
  if (!arguments.plot_coverage.empty() && !has_covariances(report)) fail_without_covariances(report);
  if (!arguments.plot.empty()) write_file(arguments.plot, draw_evaluation(report));
  if (!arguments.plot_coverage.empty()) write_file(arguments.plot_coverage, draw_coverage(report));
}

/// Says on stderr why there is nothing to compare and what to do, or what to beware of.
void print_doubts(const EvaluationReport& report, std::size_t index, std::int64_t start_offset_ns) {
  const EvaluatedTrajectory& evaluated = report.estimates[index];
  const TrajectoryEvaluation& result = evaluated.result;
  const std::string name = report.estimates.size() > 1 ? short_name(evaluated.path) + ": " : "";
  if (result.status == EvaluationStatus::no_pairs) {
    fmt::print(
        stderr, "cairn: {}{}\n", name,
        explain_no_pairs(evaluated.estimate, report.reference, report.options.max_gap_s, start_offset_ns));
  } else if (result.status == EvaluationStatus::not_alignable) {
    fmt::print(stderr, "cairn: {}no alignment by {} from {} pairs: {}.\n  Compare without: --align none.\n",
               name, name_of(report.options.alignment), result.pairs.size(), explain(result.absolute.status));
  } else {
    warn_of_free_turn(short_name(evaluated.path), result.absolute.turn_uncertainty);
  }
}

}  // namespace

int run_evaluate(int argc, char** argv) {
  EvaluateArguments arguments;
  CommandLine app(
      "How far trajectories are from the truth (ATE, RPE, drift), and whether stated covariances hold.",
      "evaluate");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  if (arguments.landmarks) {
    check_for_landmarks(app, arguments);
    return evaluate_map(landmark_arguments(app, arguments));
  }
  check(arguments);
  ComparedTrajectories compared =
      read_compared({arguments.estimates, arguments.reference, arguments.camera, arguments.offset});
  if (!compared.has_times) leave_out_times(arguments);
  const std::vector<std::int64_t> start_offsets_ns = compared.start_offsets_ns;
  const EvaluationReport report = evaluate(arguments, std::move(compared));
  for (std::size_t i = 0; i < report.estimates.size(); ++i) print_doubts(report, i, start_offsets_ns.at(i));
  const auto failed = std::count_if(report.estimates.begin(), report.estimates.end(),
                                    [](const auto& e) { return e.result.status != EvaluationStatus::ok; });
  const bool any = failed < std::ssize(report.estimates);
  if (any) write_plots(arguments, report);
  if (arguments.common.json) {
    fmt::print("{}", format_evaluation_json(report));
  } else if (any) {
    fmt::print("{}", format_evaluation_text(report));
  }
  return failed == 0 ? 0 : 1;
}

}  // namespace cairn::app
