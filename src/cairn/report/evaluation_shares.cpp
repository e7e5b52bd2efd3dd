// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cairn/report/evaluation_text.h"
#include "cairn/report/ratio.h"
#include "cairn/report/text_table.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

std::string share_of(std::size_t count, std::size_t whole) {
  return fmt::format("{:.1f} % of {}", share_percent(count, whole), whole);
}

bool is_ok(const EvaluatedTrajectory& evaluated) {
  return evaluated.result.status == EvaluationStatus::ok;
}

std::string row_name(const EvaluationReport& report, const EvaluatedTrajectory& evaluated) {
  return report.estimates.size() == 1 ? "EST" : short_name(evaluated.path);
}

ShownUnit unit_of(const EvaluationReport& report) {
  double largest_m = 0;
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    if (is_ok(evaluated)) largest_m = std::max(largest_m, evaluated.result.absolute.ate_m->max);
  return unit_for(largest_m);
}

TableRow percentiles_row(const EvaluationReport& report, const EvaluatedTrajectory& evaluated,
                         const ShownUnit& unit) {
  TableRow row{row_name(report, evaluated)};
  const auto add = [&](const std::vector<double>& errors, double factor) {
    for (const double percent : kPercents)
      row.push_back(is_ok(evaluated) ? fmt::format("{:.3f}", factor * percentile_of(errors, percent)) : "-");
  };
  add(evaluated.result.errors.translation_m, unit.factor);
  add(evaluated.result.errors.rotation_deg, 1);
  return row;
}

std::string format_percentiles(const EvaluationReport& report) {
  const ShownUnit unit = unit_of(report);
  TableRow names{fmt::format("percentiles, {}", name_of(report.options.alignment))}, units{""};
  for (const std::string_view of : {unit.name, std::string_view("deg")})
    for (const double percent : kPercents) {
      names.push_back(fmt::format("{:g} %", percent));
      units.emplace_back(of);
    }
  std::vector<TableRow> rows{names, units};
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    rows.push_back(percentiles_row(report, evaluated, unit));
  return fmt::format("\n{}", format_table(rows));
}

TableRow within_row(const EvaluationReport& report, const EvaluatedTrajectory& evaluated,
                    const PoseTolerance& tolerance) {
  TableRow row{row_name(report, evaluated)};
  if (!is_ok(evaluated)) {
    row.resize(report.queries ? 6 : 5, "-");
    return row;
  }
  const std::size_t count = count_within(evaluated.result.errors, tolerance);
  row.push_back(fmt::format("{}", count));
  row.push_back(share_of(count, evaluated.result.pairs.size()));
  row.push_back(share_of(count, evaluated.estimate.size()));
  row.push_back(share_of(count, report.reference.size()));
  if (report.queries) row.push_back(share_of(count, static_cast<std::size_t>(*report.queries)));
  return row;
}

std::string format_within(const EvaluationReport& report, const PoseTolerance& tolerance) {
  TableRow names{fmt::format("within {:g} m and {:g} deg", tolerance.translation_m, tolerance.rotation_deg),
                 "poses", "of the pairs", "of EST", "of REF"};
  if (report.queries) names.emplace_back("of the queries");
  std::vector<TableRow> rows{names};
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    rows.push_back(within_row(report, evaluated, tolerance));
  return fmt::format("\n{}", format_table(rows));
}

}  // namespace

std::string format_evaluation_shares(const EvaluationReport& report) {
  std::string text = format_percentiles(report);
  for (const PoseTolerance& tolerance : report.tolerances) text += format_within(report, tolerance);
  return text;
}

}  // namespace cairn
