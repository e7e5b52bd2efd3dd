// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cairn/report/evaluation_text.h"
#include "cairn/report/text_table.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

std::string rmse(const std::optional<ErrorStatistics>& errors, const ShownUnit& unit) {
  return errors ? fmt::format("{:.3f}", unit.factor * errors->rmse) : "-";
}

/// Returns the names of the columns and, below them, their units.
std::vector<TableRow> head(const EvaluationOptions& options, const ShownUnit& unit) {
  const std::string length(unit.name);
  TableRow names{"", "pairs"}, units{"rmse", ""};
  const auto add = [&](const std::string& name, const std::string& of) {
    names.push_back(name);
    units.push_back(of);
  };
  if (options.alignment == AlignmentMode::none) add("ATE none", length);
  add("ATE se3", length);
  add("ATE sim3", length);
  add("scale", "");
  add("ATE rot.", "deg");
  for (const RpeOptions& rpe : options.rpe) {
    add("RPE " + name_of(rpe), length);
    add("", "deg");
  }
  add("drift", "%");
  add("", "deg/m");
  return {names, units};
}

TableRow row_of(const EvaluationOptions& options, const EvaluatedTrajectory& evaluated,
                const ShownUnit& unit) {
  const TrajectoryEvaluation& result = evaluated.result;
  TableRow row{short_name(evaluated.path), fmt::format("{}", result.pairs.size())};
  const ShownUnit degrees{"deg", 1};
  if (options.alignment == AlignmentMode::none) row.push_back(rmse(result.absolute.ate_m, unit));
  row.push_back(rmse(result.se3.ate_m, unit));
  row.push_back(rmse(result.sim3.ate_m, unit));
  row.push_back(result.sim3.ate_m ? fmt::format("{:.4f}", result.sim3.reference_from_estimate.scale) : "-");
  row.push_back(rmse(result.absolute.ate_deg, degrees));
  for (std::size_t k = 0; k < options.rpe.size(); ++k) {
    const bool known = k < result.relative.size();
    row.push_back(known ? rmse(result.relative[k].rpe_m, unit) : "-");
    row.push_back(known ? rmse(result.relative[k].rpe_deg, degrees) : "-");
  }
  row.push_back(result.drift ? fmt::format("{:.4f}", result.drift->all.translation_percent) : "-");
  row.push_back(result.drift ? fmt::format("{:.6f}", result.drift->all.rotation_deg_per_m) : "-");
  return row;
}

}  // namespace

std::string format_evaluation_table(const EvaluationReport& report) {
  double largest_m = 0;
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    if (const auto& ate_m = evaluated.result.absolute.ate_m) largest_m = std::max(largest_m, ate_m->max);
  const ShownUnit unit = unit_for(largest_m);
  std::vector<TableRow> rows = head(report.options, unit);
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    rows.push_back(row_of(report.options, evaluated, unit));
  return fmt::format("reference  {}, {} poses; {}; all but ATE aligned by {}\n\n{}", report.reference_path,
                     report.reference.size(), describe_pairing(report), name_of(report.options.alignment),
                     format_table(rows));
}

}  // namespace cairn
