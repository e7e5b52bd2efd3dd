// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/evaluation_text.h"

#include <fmt/format.h>

#include <numbers>

#include "cairn/core/error.h"
#include "cairn/report/consistency_report.h"
#include "cairn/report/ratio.h"
#include "cairn/report/text_builder.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

void add_row(const std::string& name, const ShownUnit& unit, const std::optional<ErrorStatistics>& errors,
             TextBuilder& text) {
  if (!errors) return;
  const ErrorStatistics& e = *errors;
  text.add("{:<16} {:>4} {:>7}", name, unit.name, e.count);
  for (const double value : {e.rmse, e.mean, e.median, e.std, e.min, e.max})
    text.add(" {:>9.3f}", unit.factor * value);
  text.add("\n");
}

std::string describe_alignment(const EvaluationReport& report, const TrajectoryEvaluation& result) {
  const AlignmentMode alignment = report.options.alignment;
  if (alignment == AlignmentMode::none) return "none: both in one frame";
  const Similarity3& map = result.absolute.reference_from_estimate;
  std::string text = fmt::format("{}: turned {:.2f} deg", name_of(alignment),
                                 180.0 / std::numbers::pi * rotation_angle(map.rotation));
  text += fmt::format(", moved {:.3f} m", map.translation.norm());
  if (alignment == AlignmentMode::sim3) text += fmt::format(", scale {:.6f}", map.scale);
  return text;
}

void add_absolute(const EvaluationReport& report, const TrajectoryEvaluation& result, TextBuilder& text) {
  const ShownUnit shown = unit_for(result.absolute.ate_m->max);
  if (report.options.alignment == AlignmentMode::none)
    add_row("ATE none", shown, result.absolute.ate_m, text);
  add_row("ATE se3", shown, result.se3.ate_m, text);
  add_row("ATE sim3", shown, result.sim3.ate_m, text);
  // se3 and sim3 turn alike
  add_row("ATE rotation", {"deg", 1}, result.absolute.ate_deg, text);
}

void add_relative(const TrajectoryEvaluation& result, TextBuilder& text) {
  const ShownUnit shown = unit_for(result.absolute.ate_m->max);
  for (const auto& [options, rpe_m, rpe_deg] : result.relative) {
    add_row("RPE " + name_of(options), shown, rpe_m, text);
    add_row("", {"deg", 1}, rpe_deg, text);
  }
  for (const auto& [options, rpe_m, rpe_deg] : result.relative)
    if (!rpe_m) text.add("no RPE over {}: there is no such interval among the pairs\n", name_of(options));
}

void add_drift(const std::optional<Drift>& drift, TextBuilder& text) {
  if (!drift) return;
  text.add("\ndrift of KITTI   segments  translation     rotation\n");
  const auto row = [&](const std::string& name, const DriftFigures& figures) {
    text.add("{:<16} {:>8} {:>10.4f} % {:>12.6f} deg/m\n", name, figures.segments,
             figures.translation_percent, figures.rotation_deg_per_m);
  };
  for (const DriftFigures& figures : drift->by_length) row(fmt::format("{} m", figures.length_m), figures);
  row("all", drift->all);
}

std::string format_one(const EvaluationReport& report) {
  const EvaluatedTrajectory& evaluated = report.estimates.front();
  const TrajectoryEvaluation& result = evaluated.result;
  require(result.status == EvaluationStatus::ok, "a single estimate is aligned");
  const std::size_t pairs = result.pairs.size();
  TextBuilder text;
  text.add("pairs      {} ({:.1f} % of EST, {:.1f} % of REF), {}\n", pairs,
           share_percent(pairs, evaluated.estimate.size()), share_percent(pairs, report.reference.size()),
           describe_pairing(report));
  text.add("alignment  {}\n", describe_alignment(report, result));
  if (result.sim3.ate_m) text.add("scale      {:.6f} by sim3\n", result.sim3.reference_from_estimate.scale);
  text.add("\n{:<16} {:>4} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", "", "number", "rmse", "mean",
           "median", "std", "min", "max");
  add_absolute(report, result, text);
  add_relative(result, text);
  add_drift(result.drift, text);
  return text.take();
}

}  // namespace

std::string describe_pairing(const EvaluationReport& report) {
  return report.has_times ? fmt::format("stamps within {} s", report.options.max_gap_s)
                          : "by their order, as no file has time stamps";
}

std::string format_evaluation_text(const EvaluationReport& report) {
  const std::string figures =
      report.estimates.size() == 1 ? format_one(report) : format_evaluation_table(report);
  return figures + format_evaluation_shares(report) + format_stated_poses(report);
}

}  // namespace cairn
