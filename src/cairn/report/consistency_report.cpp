// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/consistency_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/report/coverage_plot.h"
#include "cairn/report/text_builder.h"
#include "cairn/report/text_table.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string in_percent(double share) {
  return fmt::format("{:.1f}", 100 * share);
}

/// Returns a length in millimetres, centimetres or metres, or an angle in degrees, with three digits.
std::string length_text(double value, ErrorUnit unit) {
  if (unit == ErrorUnit::radians) return fmt::format("{:.3g} deg", kDegrees * value);
  if (value < 0.01) return fmt::format("{:.3g} mm", 1e3 * value);
  return value < 1 ? fmt::format("{:.3g} cm", 1e2 * value) : fmt::format("{:.4g} m", value);
}

TableRow cells_of(const ConsistencyRow& row) {
  const auto& [report, median_std, median_error, expected_median_error] = row.consistency;
  TableRow cells{row.name, fmt::format("{}", report.count), fmt::format("{:.3g}", report.mean_per_freedom()),
                 fmt::format("{:.3g}", report.median_ratio())};
  for (const Coverage& coverage : report.coverage) cells.push_back(in_percent(coverage.actual));
  const bool has_lengths = row.unit != ErrorUnit::mixed;
  cells.push_back(has_lengths ? length_text(median_std, row.unit) : "");
  cells.push_back(has_lengths ? length_text(median_error, row.unit) : "");
  cells.push_back(has_lengths && median_error > 0 ? fmt::format("{:.3g}", row.consistency.std_per_error())
                                                  : "");
  cells.push_back(has_lengths ? fmt::format("{:.3g}", row.consistency.honest_std_per_error()) : "");
  return cells;
}

/// Returns what honest covariances show.
TableRow honest_cells() {
  TableRow cells{"if honest", "", "1", "1"};
  for (const double share : kNominalShares) cells.push_back(in_percent(share));
  cells.resize(cells.size() + 4);
  return cells;
}

std::string name_of(const StatedPoses& stated) {
  switch (stated.scope) {
    case CovarianceScope::absolute:
      return stated.is_weak ? "absolute, weak poses" : "absolute";
    case CovarianceScope::in_map:
      return stated.is_weak ? "in the map, weak poses" : "in the map";
    case CovarianceScope::from_first:
      return "from the first keyframe";
    case CovarianceScope::from_previous:
      return "from the keyframe before";
  }
  return "";
}

void add_rows(const std::string& prefix, const StatedPoses& stated, std::vector<ConsistencyRow>& rows) {
  if (!stated.consistency) return;
  const std::string name = prefix + name_of(stated);
  rows.push_back({name + ": pose", stated.consistency->pose, ErrorUnit::mixed});
  rows.push_back({"  position", stated.consistency->position, ErrorUnit::metres});
  rows.push_back({"  rotation", stated.consistency->rotation, ErrorUnit::radians});
}

/// Says which poses are in no row.
void add_missing(const std::string& prefix, const StatedPoses& stated, TextBuilder& text) {
  if (stated.without_truth > 0)
    text.add("{}{}: {} without a pose of REF\n", prefix, name_of(stated), stated.without_truth);
  if (stated.without_covariance > 0)
    text.add("{}{}: {} without a covariance\n", prefix, name_of(stated), stated.without_covariance);
}

bool depends_on_alignment(const StatedPoses& stated) {
  return stated.scope == CovarianceScope::absolute || stated.scope == CovarianceScope::in_map;
}

/// Returns whether an alignment has moved poses whose covariances are of the world.
bool hides_errors(const EvaluationReport& report) {
  if (report.options.alignment == AlignmentMode::none) return false;
  return std::any_of(
      report.estimates.begin(), report.estimates.end(), [](const EvaluatedTrajectory& evaluated) {
        return std::any_of(evaluated.covariances.begin(), evaluated.covariances.end(), depends_on_alignment);
      });
}

}  // namespace

std::string format_consistencies(const std::string& head, const std::string& what,
                                 const std::vector<ConsistencyRow>& rows) {
  TableRow names{head, what, "NEES/dof", "NEES/dof"}, units{"", "", "mean", "median"};
  for (const double share : kNominalShares) {
    names.push_back(fmt::format("in {:g} %", 100 * share));
    units.emplace_back("%");
  }
  names.insert(names.end(), {"stated std", "error", "std/error", "if honest"});
  units.insert(units.end(), {"median", "median", "", ""});
  std::vector<TableRow> table{names, units};
  for (const ConsistencyRow& row : rows) table.push_back(cells_of(row));
  table.push_back(honest_cells());
  return format_table(table);
}

Json consistency_json(const ErrorConsistency& consistency, ErrorUnit unit) {
  const ConsistencyReport& report = consistency.report;
  const double freedoms = report.degrees_of_freedom;
  Json json;
  json["errors"] = report.count;
  json["degrees_of_freedom"] = report.degrees_of_freedom;
  json["mean_nees_per_dof"] = report.mean_per_freedom();
  json["mean_nees_per_dof_interval_95"] = {report.mean_nees_low / freedoms, report.mean_nees_high / freedoms};
  json["median_nees_ratio"] = report.median_ratio();
  json["verdict"] = word_for(report.verdict);
  json["coverage"] = Json::array();
  for (const Coverage& coverage : report.coverage)
    json["coverage"].push_back({{"nominal", coverage.nominal},
                                {"inside", coverage.inside},
                                {"share", coverage.actual},
                                {"standard_error", coverage.standard_error}});
  if (unit == ErrorUnit::mixed) return json;
  const char* const suffix = unit == ErrorUnit::metres ? "m" : "deg";
  const double factor = unit == ErrorUnit::metres ? 1 : kDegrees;
  json[fmt::format("median_std_{}", suffix)] = factor * consistency.median_std;
  json[fmt::format("median_error_{}", suffix)] = factor * consistency.median_error;
  json[fmt::format("expected_median_error_{}", suffix)] = factor * consistency.expected_median_error;
  json["std_per_error"] = consistency.median_error > 0 ? Json(consistency.std_per_error()) : Json();
  json["honest_std_per_error"] = consistency.honest_std_per_error();
  return json;
}

std::string_view word_for(CovarianceVerdict verdict) {
  switch (verdict) {
    case CovarianceVerdict::honest:
      return "honest";
    case CovarianceVerdict::overconfident:
      return "overconfident";
    case CovarianceVerdict::pessimistic:
      return "pessimistic";
  }
  return "";
}

std::string_view word_for(CovarianceScope scope) {
  switch (scope) {
    case CovarianceScope::absolute:
      return "absolute";
    case CovarianceScope::in_map:
      return "in_map";
    case CovarianceScope::from_first:
      return "from_first";
    case CovarianceScope::from_previous:
      return "from_previous";
  }
  return "";
}

std::string format_stated_poses(const EvaluationReport& report) {
  std::vector<ConsistencyRow> rows;
  TextBuilder missing;
  for (const EvaluatedTrajectory& evaluated : report.estimates) {
    const std::string prefix = report.estimates.size() > 1 ? short_name(evaluated.path) + " " : "";
    for (const StatedPoses& stated : evaluated.covariances) {
      add_rows(prefix, stated, rows);
      add_missing(prefix, stated, missing);
    }
  }
  std::string text;
  if (!rows.empty())
    text = "\n" + format_consistencies(fmt::format("covariances, {}", name_of(report.options.alignment)),
                                       "poses", rows);
  text += missing.take();
  if (!rows.empty() && hides_errors(report))
    text +=
        "The alignment hides the part of the error that all poses have in common; --align none shows it.\n";
  return text;
}

std::string draw_coverage(const EvaluationReport& report) {
  CoveragePlot plot;
  plot.title = "Are stated covariances honest?";
  const bool single = report.estimates.size() == 1;
  const std::string estimates = single ? short_name(report.estimates.front().path)
                                       : fmt::format("{} estimates", report.estimates.size());
  plot.subtitle = fmt::format("{} against {}, alignment {}", estimates, short_name(report.reference_path),
                              name_of(report.options.alignment));
  for (const EvaluatedTrajectory& evaluated : report.estimates) {
    for (const StatedPoses& stated : evaluated.covariances) {
      if (!stated.consistency) continue;
      const std::string name = single ? name_of(stated) : short_name(evaluated.path) + ", " + name_of(stated);
      plot.panels.push_back({name,
                             {{"pose", stated.consistency->pose.report},
                              {"position", stated.consistency->position.report},
                              {"rotation", stated.consistency->rotation.report}}});
    }
  }
  return draw_coverage_plot(plot);
}

Json stated_poses_json(const std::vector<StatedPoses>& covariances) {
  Json json = Json::array();
  for (const StatedPoses& stated : covariances) {
    Json one;
    one["scope"] = word_for(stated.scope);
    one["weak"] = stated.is_weak;
    one["without_truth"] = stated.without_truth;
    one["without_covariance"] = stated.without_covariance;
    if (stated.consistency) {
      one["pose"] = consistency_json(stated.consistency->pose, ErrorUnit::mixed);
      one["position"] = consistency_json(stated.consistency->position, ErrorUnit::metres);
      one["rotation"] = consistency_json(stated.consistency->rotation, ErrorUnit::radians);
    }
    json.push_back(one);
  }
  return json;
}

}  // namespace cairn
