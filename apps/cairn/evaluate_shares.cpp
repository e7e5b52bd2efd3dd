// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "evaluate_output.h"
#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

std::string share_of(std::size_t count, std::size_t whole) {
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(count) / static_cast<double>(whole));
}

bool is_ok(const Evaluated& evaluated) {
  return evaluated.result.status == EvaluationStatus::ok;
}

std::string name_of(const Evaluations& evaluations, const Evaluated& evaluated) {
  return evaluations.estimates.size() == 1 ? "EST" : short_name(evaluated.path);
}

ShownUnit unit_of(const Evaluations& evaluations) {
  double largest_m = 0;
  for (const Evaluated& evaluated : evaluations.estimates)
    if (is_ok(evaluated)) largest_m = std::max(largest_m, evaluated.result.absolute.ate_m->max);
  return unit_for(largest_m);
}

Row percentiles_of(const Evaluations& evaluations, const Evaluated& evaluated, const ShownUnit& unit) {
  const PoseErrors& errors = evaluated.result.errors;
  Row row{name_of(evaluations, evaluated)};
  for (const double percent : kPercents)
    row.push_back(is_ok(evaluated)
                      ? fmt::format("{:.3f}", unit.factor * percentile_of(errors.translation_m, percent))
                      : "-");
  for (const double percent : kPercents)
    row.push_back(is_ok(evaluated) ? fmt::format("{:.3f}", percentile_of(errors.rotation_deg, percent))
                                   : "-");
  return row;
}

void print_percentiles(const Evaluations& evaluations) {
  const ShownUnit unit = unit_of(evaluations);
  Row names{fmt::format("percentiles, {}", evaluations.arguments.align)}, units{""};
  for (const std::string_view of : {unit.name, std::string_view("deg")})
    for (const double percent : kPercents) {
      names.push_back(fmt::format("{:g} %", percent));
      units.emplace_back(of);
    }
  std::vector<Row> rows{names, units};
  for (const Evaluated& evaluated : evaluations.estimates)
    rows.push_back(percentiles_of(evaluations, evaluated, unit));
  fmt::print("\n");
  print_table(rows);
}

Row within_row(const Evaluations& evaluations, const Evaluated& evaluated, std::size_t which) {
  Row row{name_of(evaluations, evaluated)};
  const bool queries = evaluations.arguments.queries.has_value();
  if (!is_ok(evaluated)) {
    row.resize(queries ? 6 : 5, "-");
    return row;
  }
  const std::size_t count = count_within_each(evaluations.arguments, evaluated.result)[which].count;
  const auto add = [&](std::size_t whole) {
    row.push_back(fmt::format("{} of {}", share_of(count, whole), whole));
  };
  row.push_back(fmt::format("{}", count));
  add(evaluated.result.pairs.size());
  add(evaluated.estimate.size());
  add(evaluations.reference.size());
  if (queries) add(static_cast<std::size_t>(*evaluations.arguments.queries));
  return row;
}

void print_within(const Evaluations& evaluations, std::size_t which) {
  const PoseTolerance& tolerance = evaluations.arguments.tolerances[which];
  Row names{fmt::format("within {:g} m and {:g} deg", tolerance.translation_m, tolerance.rotation_deg),
            "poses", "of the pairs", "of EST", "of REF"};
  if (evaluations.arguments.queries) names.emplace_back("of the queries");
  std::vector<Row> rows{names};
  for (const Evaluated& evaluated : evaluations.estimates)
    rows.push_back(within_row(evaluations, evaluated, which));
  fmt::print("\n");
  print_table(rows);
}

}  // namespace

std::vector<WithinCount> count_within_each(const EvaluateArguments& arguments,
                                           const TrajectoryEvaluation& result) {
  std::vector<WithinCount> counts;
  for (const PoseTolerance& tolerance : arguments.tolerances)
    counts.push_back({tolerance, count_within(result.errors, tolerance)});
  return counts;
}

void print_shares(const Evaluations& evaluations) {
  print_percentiles(evaluations);
  for (std::size_t i = 0; i < evaluations.arguments.tolerances.size(); ++i) print_within(evaluations, i);
}

}  // namespace cairn::app
