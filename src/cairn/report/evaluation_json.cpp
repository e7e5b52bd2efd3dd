// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/report/consistency_report.h"
#include "cairn/report/evaluation_report.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

/// Adds the keys PREFIXrmse_UNIT and so on; null if there are no errors.
void add_statistics(const std::string& prefix, const std::string& unit,
                    const std::optional<ErrorStatistics>& errors, Json& json) {
  const auto put = [&](const char* statistic, double ErrorStatistics::*value) {
    json[fmt::format("{}{}_{}", prefix, statistic, unit)] = errors ? Json((*errors).*value) : nullptr;
  };
  put("rmse", &ErrorStatistics::rmse);
  put("mean", &ErrorStatistics::mean);
  put("median", &ErrorStatistics::median);
  put("std", &ErrorStatistics::std);
  put("min", &ErrorStatistics::min);
  put("max", &ErrorStatistics::max);
}

Json absolute_json(const AbsoluteErrors& absolute) {
  Json json;
  json["status"] = word_for(absolute.status);
  if (absolute.status != AlignmentStatus::ok) return json;
  add_similarity(absolute.reference_from_estimate, json);
  json["turn_uncertainty_deg"] = 180.0 / std::numbers::pi * absolute.turn_uncertainty;
  add_statistics("ate_", "m", absolute.ate_m, json);
  add_statistics("ate_", "deg", absolute.ate_deg, json);
  return json;
}

Json relative_json(const RelativeErrors& relative) {
  Json json;
  json["delta"] = relative.options.delta;
  json["unit"] = name_of(relative.options.unit);
  json["all_pairs"] = relative.options.all_pairs;
  json["intervals"] = relative.rpe_m ? relative.rpe_m->count : 0;
  add_statistics("", "m", relative.rpe_m, json);
  add_statistics("", "deg", relative.rpe_deg, json);
  return json;
}

Json figures_json(const DriftFigures& figures) {
  Json json;
  if (figures.length_m > 0) json["length_m"] = figures.length_m;
  json["segments"] = figures.segments;
  json["translation_percent"] = figures.translation_percent;
  json["rotation_deg_per_m"] = figures.rotation_deg_per_m;
  return json;
}

Json drift_json(const std::optional<Drift>& drift) {
  if (!drift) return nullptr;
  Json json = figures_json(drift->all);
  json["by_length"] = Json::array();
  for (const DriftFigures& figures : drift->by_length) json["by_length"].push_back(figures_json(figures));
  return json;
}

Json percentiles_json(const PoseErrors& errors) {
  Json json = Json::array();
  for (const double percent : kPercents)
    json.push_back({{"percent", percent},
                    {"m", percentile_of(errors.translation_m, percent)},
                    {"deg", percentile_of(errors.rotation_deg, percent)}});
  return json;
}

Json within_json(const EvaluationReport& report, const EvaluatedTrajectory& evaluated) {
  Json json = Json::array();
  for (const PoseTolerance& tolerance : report.tolerances) {
    const std::size_t count = count_within(evaluated.result.errors, tolerance);
    const auto share = [count](std::size_t whole) {
      return static_cast<double>(count) / static_cast<double>(whole);
    };
    json.push_back({{"position_m", tolerance.translation_m},
                    {"rotation_deg", tolerance.rotation_deg},
                    {"count", count},
                    {"share_of_pairs", share(evaluated.result.pairs.size())},
                    {"share_of_estimate", share(evaluated.estimate.size())},
                    {"share_of_reference", share(report.reference.size())},
                    {"share_of_queries",
                     report.queries ? Json(share(static_cast<std::size_t>(*report.queries))) : Json()}});
  }
  return json;
}

/// Adds the first RPE in the report's unit.
void add_chosen_rpe(const EvaluationReport& report, const TrajectoryEvaluation& result, Json& json) {
  const auto chosen = std::find_if(result.relative.begin(), result.relative.end(), [&](const auto& relative) {
    return relative.options.unit == report.rpe_unit;
  });
  require(chosen != result.relative.end(), "there is an RPE in the unit of the report");
  json["rpe_delta"] = chosen->options.delta;
  json["rpe_unit"] = name_of(report.rpe_unit);
  json["rpe_all_pairs"] = chosen->options.all_pairs;
  json["rpe_intervals"] = chosen->rpe_m ? chosen->rpe_m->count : 0;
  add_statistics("rpe_", "m", chosen->rpe_m, json);
  add_statistics("rpe_", "deg", chosen->rpe_deg, json);
}

Json header_json(const EvaluationReport& report, const EvaluatedTrajectory& evaluated) {
  const TrajectoryEvaluation& result = evaluated.result;
  Json json;
  json["estimate"] = evaluated.path;
  json["reference"] = report.reference_path;
  json["status"] = word_for(result.status);
  json["pairs"] = result.pairs.size();
  json["estimate_poses"] = evaluated.estimate.size();
  json["reference_poses"] = report.reference.size();
  json["max_gap_s"] = report.options.max_gap_s;
  json["alignment"] = name_of(report.options.alignment);
  if (result.status == EvaluationStatus::not_alignable)
    json["alignment_status"] = word_for(result.absolute.status);
  return json;
}

Json evaluated_json(const EvaluationReport& report, const EvaluatedTrajectory& evaluated) {
  const TrajectoryEvaluation& result = evaluated.result;
  Json json = header_json(report, evaluated);
  if (result.status != EvaluationStatus::ok) return json;
  add_similarity(result.absolute.reference_from_estimate, json);
  add_statistics("ate_", "m", result.absolute.ate_m, json);
  add_statistics("ate_", "deg", result.absolute.ate_deg, json);
  json["ate_percentiles"] = percentiles_json(result.errors);
  json["queries"] = report.queries ? Json(*report.queries) : Json();
  json["within"] = within_json(report, evaluated);
  add_chosen_rpe(report, result, json);
  json["se3"] = absolute_json(result.se3);
  json["sim3"] = absolute_json(result.sim3);
  json["rpe"] = Json::array();
  for (const RelativeErrors& relative : result.relative) json["rpe"].push_back(relative_json(relative));
  json["drift"] = drift_json(result.drift);
  if (!evaluated.covariances.empty()) json["covariances"] = stated_poses_json(evaluated.covariances);
  return json;
}

}  // namespace

std::string format_evaluation_json(const EvaluationReport& report) {
  Json all = Json::array();
  for (const EvaluatedTrajectory& evaluated : report.estimates)
    all.push_back(evaluated_json(report, evaluated));
  return format_document(all.size() == 1 ? all[0] : Json{{"estimates", all}});
}

}  // namespace cairn
