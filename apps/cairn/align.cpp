// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "cairn/core/file.h"
#include "cairn/evaluate/pose_pairs.h"
#include "cairn/report/alignment_report.h"
#include "cairn/report/trajectory_words.h"
#include "commands.h"
#include "common.h"
#include "compared_trajectories.h"
#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

struct AlignArguments {
  CommonOptions common;
  std::string estimate, reference, camera, plot;
  StampOffset offset;
  double max_gap_s = 0.02;
  bool with_scale = false;
};

void declare(CommandLine& app, AlignArguments& arguments) {
  app.add_option(
         "EST", arguments.estimate,
         "trajectory to move (TUM, KITTI, EuRoC, OXTS packets or a table, docs/poses.md), or a run's folder; "
         "alone: a file of pairs, 16 values a line: a "
         "pose of the estimate, then one of the reference")
      .required();
  app.add_option("REF", arguments.reference,
                 "trajectory to move it onto: a file, or a sequence's folder that carries it");
  app.add_flag("--scale", arguments.with_scale, "find the scale as well: for a monocular estimate");
  app.add_option("--max-gap", arguments.max_gap_s, "between the stamps of a pair, seconds")
      .check(number_in(0, 10))
      .type_name("S")
      .show_default();
  add_stamp_offset(app, "--offset", "EST", arguments.offset);
  app.add_option("--camera", arguments.camera,
                 "camera.yaml, or tum-fr1, tum-fr2, tum-fr3, where REF is a sequence without calibration")
      .type_name("FILE|NAME");
  app.add_option("--plot", arguments.plot, "picture of both trajectories before and after")
      .check(FileEnding{".svg"})
      .type_name("OUT.svg");
  add_common_options(app, arguments.common, {.quiet = false});
  app.footer(
      "Example: cairn align run/ recording/ --plot alignment.svg\n"
      "Least squares over the camera centres in closed form (Umeyama 1991). Exit code 1: the poses do not\n"
      "determine it.");
}

/// Nothing, after a message, where no stamps are near each other.
std::vector<PosePair> read_pairs(const AlignArguments& arguments) {
  if (arguments.reference.empty()) return read_pose_pairs(arguments.estimate);
  const ComparedTrajectories compared =
      read_compared({{arguments.estimate}, arguments.reference, arguments.camera, arguments.offset});
  const Trajectory &estimate = compared.estimates[0], &reference = compared.reference;
  std::vector<PosePair> pairs = pair_poses(estimate, reference, arguments.max_gap_s);
  if (pairs.empty())
    fmt::print(stderr, "cairn: {}\n",
               explain_no_pairs(estimate, reference, arguments.max_gap_s, compared.start_offsets_ns[0]));
  return pairs;
}

}  // namespace

int run_align(int argc, char** argv) {
  AlignArguments arguments;
  CommandLine app("The rotation, translation and scale that move a trajectory onto another.", "align");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  AlignmentReport report;
  report.estimate_path = arguments.estimate;
  report.reference_path = arguments.reference;
  if (!arguments.reference.empty()) report.max_gap_s = arguments.max_gap_s;
  report.with_scale = arguments.with_scale;
  report.pairs = read_pairs(arguments);
  report.alignment = align_pairs(report.pairs, arguments.with_scale);
  report.rms_before_m = rms_distance(report.pairs);
  if (arguments.common.json) fmt::print("{}", format_alignment_json(report));
  if (report.alignment.status != AlignmentStatus::ok) {
    if (!report.pairs.empty())
      fmt::print(stderr, "cairn: no alignment from {} pairs: {}.\n", report.pairs.size(),
                 explain(report.alignment.status));
    return 1;
  }
  warn_of_free_turn(short_name(arguments.estimate), report.alignment.turn_uncertainty);
  if (!arguments.plot.empty()) write_file(arguments.plot, draw_alignment(report));
  if (!arguments.common.json) fmt::print("{}", format_alignment_text(report));
  return 0;
}

}  // namespace cairn::app
