// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/file.h"
#include "cairn/evaluate/pose_pairs.h"
#include "cairn/report/alignment_plot.h"
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

/// Pairs and what became of them.
struct Aligned {
  const AlignArguments& arguments;
  std::vector<PosePair> pairs;
  Alignment alignment;
  double rms_before_m = 0;
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

/// Three numbers with nine decimals; no -0.
std::string columns(const Eigen::Vector3d& values) {
  constexpr double kShown = 5e-10;
  std::string text;
  for (const double value : values) text += fmt::format(" {:13.9f}", std::abs(value) < kShown ? 0.0 : value);
  return text;
}

void print_alignment(const Aligned& aligned) {
  const AlignArguments& arguments = aligned.arguments;
  const Similarity3& map = aligned.alignment.target_from_source;
  const Eigen::Matrix3d R = map.rotation.toRotationMatrix();
  const std::string association =
      arguments.reference.empty() ? "" : fmt::format(", stamps within {} s", arguments.max_gap_s);
  fmt::print("pairs      {}{}\n", aligned.pairs.size(), association);
  fmt::print("transform  reference = {}R * estimate + t, from the estimate's world to the reference's\n",
             arguments.with_scale ? "s * " : "");
  for (int row = 0; row < 3; ++row) fmt::print("{:<10}{}\n", row == 0 ? "R" : "", columns(R.row(row)));
  fmt::print("{:<10}{}  m\n", "t", columns(map.translation));
  if (arguments.with_scale) fmt::print("{:<10} {:13.9f}\n", "s", map.scale);
  fmt::print("angle      {:.6f} deg\n", 180.0 / std::numbers::pi * rotation_angle(map.rotation));
  fmt::print("residual   {:.9f} m RMS before, {:.9f} m after\n", aligned.rms_before_m,
             aligned.alignment.rmse);
}

nlohmann::ordered_json to_json(const Aligned& aligned) {
  const AlignmentStatus status = aligned.alignment.status;
  nlohmann::ordered_json json;
  json["status"] = aligned.pairs.empty() ? "no_pairs" : word_for(status);
  json["pairs"] = aligned.pairs.size();
  if (status != AlignmentStatus::ok) return json;
  const Similarity3& map = aligned.alignment.target_from_source;
  const Eigen::Matrix3d R = map.rotation.toRotationMatrix();
  json["direction"] = "reference_from_estimate";
  json["rotation"] = {{R(0, 0), R(0, 1), R(0, 2)}, {R(1, 0), R(1, 1), R(1, 2)}, {R(2, 0), R(2, 1), R(2, 2)}};
  add_similarity(map, json);
  json["with_scale"] = aligned.arguments.with_scale;
  json["rms_before_m"] = aligned.rms_before_m;
  json["rms_after_m"] = aligned.alignment.rmse;
  json["turn_uncertainty_deg"] = 180.0 / std::numbers::pi * aligned.alignment.turn_uncertainty;
  return json;
}

std::string draw_alignment(const Aligned& aligned) {
  const AlignArguments& arguments = aligned.arguments;
  AlignmentPlot plot;
  plot.title =
      fmt::format("{} pairs aligned by {}", aligned.pairs.size(), arguments.with_scale ? "sim3" : "se3");
  plot.subtitle = short_name(arguments.estimate);
  if (!arguments.reference.empty()) plot.subtitle += " onto " + short_name(arguments.reference);
  plot.before = fmt::format("before: {:.4g} m RMS", aligned.rms_before_m);
  plot.after = fmt::format("after: {:.4g} m RMS", aligned.alignment.rmse);
  for (const auto& pair : aligned.pairs) {
    plot.reference.push_back(pair.reference.translation);
    plot.estimate_before.push_back(pair.estimate.translation);
    plot.estimate_after.push_back(aligned.alignment.target_from_source * pair.estimate.translation);
  }
  return draw_alignment_plot(plot);
}

}  // namespace

int run_align(int argc, char** argv) {
  AlignArguments arguments;
  CommandLine app("The rotation, translation and scale that move a trajectory onto another.", "align");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  Aligned aligned{arguments, read_pairs(arguments), {}, 0};
  aligned.alignment = align_pairs(aligned.pairs, arguments.with_scale);
  aligned.rms_before_m = rms_distance(aligned.pairs);
  if (arguments.common.json) fmt::print("{}\n", to_json(aligned).dump(2));
  if (aligned.alignment.status != AlignmentStatus::ok) {
    if (!aligned.pairs.empty())
      fmt::print(stderr, "cairn: no alignment from {} pairs: {}.\n", aligned.pairs.size(),
                 explain(aligned.alignment.status));
    return 1;
  }
  warn_of_free_turn(short_name(arguments.estimate), aligned.alignment.turn_uncertainty);
  if (!arguments.plot.empty()) write_file(arguments.plot, draw_alignment(aligned));
  if (!arguments.common.json) print_alignment(aligned);
  return 0;
}

}  // namespace cairn::app
