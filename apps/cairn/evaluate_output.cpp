// SPDX-License-Identifier: Apache-2.0
#include "evaluate_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

// ---- one estimate: all statistics ----

void print_row(const std::string& name, const ShownUnit& unit, const std::optional<ErrorStatistics>& errors) {
  if (!errors) return;
  const auto& e = *errors;
  fmt::print("{:<16} {:>4} {:>7}", name, unit.name, e.count);
  for (const double value : {e.rmse, e.mean, e.median, e.std, e.min, e.max})
    fmt::print(" {:>9.3f}", unit.factor * value);
  fmt::print("\n");
}

std::string describe_alignment(const EvaluateArguments& arguments, const TrajectoryEvaluation& result) {
  if (arguments.options.alignment == AlignmentMode::none) return "none: both in one frame";
  const Similarity3& map = result.absolute.reference_from_estimate;
  std::string text = fmt::format("{}: turned {:.2f} deg", arguments.align,
                                 180.0 / std::numbers::pi * rotation_angle(map.rotation));
  text += fmt::format(", moved {:.3f} m", map.translation.norm());
  if (arguments.options.alignment == AlignmentMode::sim3) text += fmt::format(", scale {:.6f}", map.scale);
  return text;
}

void print_absolute(const EvaluateArguments& arguments, const TrajectoryEvaluation& result) {
  const ShownUnit shown = unit_for(result.absolute.ate_m->max);
  const bool plain = arguments.options.alignment == AlignmentMode::none;
  if (plain) print_row("ATE none", shown, result.absolute.ate_m);
  print_row("ATE se3", shown, result.se3.ate_m);
  print_row("ATE sim3", shown, result.sim3.ate_m);
  // se3 and sim3 turn alike
  print_row("ATE rotation", {"deg", 1}, result.absolute.ate_deg);
}

void print_relative(const TrajectoryEvaluation& result) {
  const ShownUnit shown = unit_for(result.absolute.ate_m->max);
  for (const auto& [options, rpe_m, rpe_deg] : result.relative) {
    print_row("RPE " + name_of(options), shown, rpe_m);
    print_row("", {"deg", 1}, rpe_deg);
  }
  for (const auto& [options, rpe_m, rpe_deg] : result.relative)
    if (!rpe_m) fmt::print("no RPE over {}: there is no such interval among the pairs\n", name_of(options));
}

void print_drift(const std::optional<Drift>& drift) {
  if (!drift) return;
  fmt::print("\ndrift of KITTI   segments  translation     rotation\n");
  const auto row = [](const std::string& name, const DriftFigures& figures) {
    fmt::print("{:<16} {:>8} {:>10.4f} % {:>12.6f} deg/m\n", name, figures.segments,
               figures.translation_percent, figures.rotation_deg_per_m);
  };
  for (const auto& figures : drift->by_length) row(fmt::format("{} m", figures.length_m), figures);
  row("all", drift->all);
}

void print_one(const Evaluations& evaluations) {
  const auto& [path, estimate, result] = evaluations.estimates.front();
  const EvaluateArguments& arguments = evaluations.arguments;
  const std::size_t pairs = result.pairs.size();
  fmt::print("pairs      {} ({:.1f} % of EST, {:.1f} % of REF), {}\n", pairs, percent(pairs, estimate.size()),
             percent(pairs, evaluations.reference.size()), describe_pairing(arguments));
  fmt::print("alignment  {}\n", describe_alignment(arguments, result));
  if (result.sim3.ate_m) fmt::print("scale      {:.6f} by sim3\n", result.sim3.reference_from_estimate.scale);
  fmt::print("\n{:<16} {:>4} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "", "number", "rmse", "mean",
             "median", "std", "min", "max");
  print_absolute(arguments, result);
  print_relative(result);
  print_drift(result.drift);
}

// ---- several estimates: a row each ----

std::string rmse(const std::optional<ErrorStatistics>& errors, const ShownUnit& unit) {
  return errors ? fmt::format("{:.3f}", unit.factor * errors->rmse) : "-";
}

/// Names and, below them, units.
std::pair<Row, Row> head(const EvaluateArguments& arguments, const ShownUnit& unit) {
  const std::string length(unit.name);
  Row names{"", "pairs"}, units{"rmse", ""};
  const auto add = [&](const std::string& name, const std::string& of) {
    names.push_back(name);
    units.push_back(of);
  };
  if (arguments.options.alignment == AlignmentMode::none) add("ATE none", length);
  add("ATE se3", length);
  add("ATE sim3", length);
  add("scale", "");
  add("ATE rot.", "deg");
  for (const auto& rpe : arguments.options.rpe) {
    add("RPE " + name_of(rpe), length);
    add("", "deg");
  }
  add("drift", "%");
  add("", "deg/m");
  return {names, units};
}

Row row_of(const EvaluateArguments& arguments, const Evaluated& evaluated, const ShownUnit& unit) {
  const auto& [path, estimate, result] = evaluated;
  Row row{short_name(path), fmt::format("{}", result.pairs.size())};
  const ShownUnit degrees{"deg", 1};
  if (arguments.options.alignment == AlignmentMode::none) row.push_back(rmse(result.absolute.ate_m, unit));
  row.push_back(rmse(result.se3.ate_m, unit));
  row.push_back(rmse(result.sim3.ate_m, unit));
  row.push_back(result.sim3.ate_m ? fmt::format("{:.4f}", result.sim3.reference_from_estimate.scale) : "-");
  row.push_back(rmse(result.absolute.ate_deg, degrees));
  for (std::size_t k = 0; k < arguments.options.rpe.size(); ++k) {
    const bool known = k < result.relative.size();
    row.push_back(known ? rmse(result.relative[k].rpe_m, unit) : "-");
    row.push_back(known ? rmse(result.relative[k].rpe_deg, degrees) : "-");
  }
  row.push_back(result.drift ? fmt::format("{:.4f}", result.drift->all.translation_percent) : "-");
  row.push_back(result.drift ? fmt::format("{:.6f}", result.drift->all.rotation_deg_per_m) : "-");
  return row;
}

void print_several(const Evaluations& evaluations) {
  const EvaluateArguments& arguments = evaluations.arguments;
  double largest_m = 0;
  for (const auto& evaluated : evaluations.estimates)
    if (const auto& ate_m = evaluated.result.absolute.ate_m) largest_m = std::max(largest_m, ate_m->max);
  const ShownUnit unit = unit_for(largest_m);
  fmt::print("reference  {}, {} poses; {}; all but ATE aligned by {}\n\n", arguments.reference,
             evaluations.reference.size(), describe_pairing(arguments), arguments.align);
  const auto [names, units] = head(arguments, unit);
  std::vector<Row> rows{names, units};
  for (const auto& evaluated : evaluations.estimates) rows.push_back(row_of(arguments, evaluated, unit));
  print_table(rows);
}

}  // namespace

std::string describe_pairing(const EvaluateArguments& arguments) {
  return arguments.has_times ? fmt::format("stamps within {} s", arguments.options.max_gap_s)
                             : "by their order, as no file has time stamps";
}

void print_table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  for (const auto& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) line += fmt::format("  {:>{}}", row[k], widths[k]);
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

ShownUnit unit_for(double largest_error_m) {
  constexpr double kFarM = 10;
  return largest_error_m < kFarM ? ShownUnit{"cm", 100} : ShownUnit{"m", 1};
}

std::string_view name_of(RpeUnit unit) {
  switch (unit) {
    case RpeUnit::metres:
      return "metres";
    case RpeUnit::seconds:
      return "seconds";
    case RpeUnit::frames:
      break;
  }
  return "frames";
}

std::string name_of(const RpeOptions& options) {
  if (options.unit == RpeUnit::frames)
    return fmt::format("{} frame{}", options.delta, options.delta == 1 ? "" : "s");
  return fmt::format("{} {}", options.delta, options.unit == RpeUnit::metres ? "m" : "s");
}

void print_doubts(const Evaluations& evaluations, const Evaluated& evaluated) {
  const EvaluateArguments& arguments = evaluations.arguments;
  const auto& [path, estimate, result] = evaluated;
  const std::string name = evaluations.estimates.size() > 1 ? short_name(path) + ": " : "";
  if (result.status == EvaluationStatus::no_pairs) {
    const auto index = static_cast<std::size_t>(&evaluated - evaluations.estimates.data());
    fmt::print(stderr, "cairn: {}{}\n", name,
               explain_no_pairs(estimate, evaluations.reference, arguments.options.max_gap_s,
                                evaluations.start_offsets_ns.at(index)));
  } else if (result.status == EvaluationStatus::not_alignable) {
    fmt::print(stderr, "cairn: {}no alignment by {} from {} pairs: {}.\n  Compare without: --align none.\n",
               name, arguments.align, result.pairs.size(), explain(result.absolute.status));
  } else {
    warn_of_free_turn(short_name(path), result.absolute.turn_uncertainty);
  }
}

void print_evaluations(const Evaluations& evaluations) {
  evaluations.estimates.size() == 1 ? print_one(evaluations) : print_several(evaluations);
  print_shares(evaluations);
}

}  // namespace cairn::app
