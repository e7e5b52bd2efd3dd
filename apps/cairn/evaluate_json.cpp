// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "evaluate_output.h"
#include "trajectory_inputs.h"

namespace cairn::app {
namespace {

using Json = nlohmann::ordered_json;

/// The keys PREFIXrmse_UNIT and so on; null where there are no errors.
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

std::string_view status_word(EvaluationStatus status) {
  switch (status) {
    case EvaluationStatus::no_pairs:
      return "no_pairs";
    case EvaluationStatus::not_alignable:
      return "not_alignable";
    case EvaluationStatus::ok:
      break;
  }
  return "ok";
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

Json drift_json(const std::optional<Drift>& drift) {
  if (!drift) return nullptr;
  const auto figures_json = [](const DriftFigures& figures) {
    Json json;
    if (figures.length_m > 0) json["length_m"] = figures.length_m;
    json["segments"] = figures.segments;
    json["translation_percent"] = figures.translation_percent;
    json["rotation_deg_per_m"] = figures.rotation_deg_per_m;
    return json;
  };
  Json json = figures_json(drift->all);
  json["by_length"] = Json::array();
  for (const auto& figures : drift->by_length) json["by_length"].push_back(figures_json(figures));
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

Json within_json(const EvaluateArguments& arguments, const Trajectory& reference,
                 const Evaluated& evaluated) {
  Json json = Json::array();
  for (const auto& [tolerance, count] : count_within_each(arguments, evaluated.result)) {
    const auto share = [count = count](std::size_t whole) {
      return static_cast<double>(count) / static_cast<double>(whole);
    };
    json.push_back(
        {{"position_m", tolerance.translation_m},
         {"rotation_deg", tolerance.rotation_deg},
         {"count", count},
         {"share_of_pairs", share(evaluated.result.pairs.size())},
         {"share_of_estimate", share(evaluated.estimate.size())},
         {"share_of_reference", share(reference.size())},
         {"share_of_queries",
          arguments.queries ? Json(share(static_cast<std::size_t>(*arguments.queries))) : Json()}});
  }
  return json;
}

/// The RPE of --rpe-delta and --rpe-unit, the first where there are several.
void add_chosen_rpe(const EvaluateArguments& arguments, const TrajectoryEvaluation& result, Json& json) {
  const auto chosen = std::find_if(result.relative.begin(), result.relative.end(), [&](const auto& relative) {
    return name_of(relative.options.unit) == arguments.rpe_unit;
  });
  json["rpe_delta"] = chosen->options.delta;
  json["rpe_unit"] = arguments.rpe_unit;
  json["rpe_all_pairs"] = arguments.rpe_all_pairs;
  json["rpe_intervals"] = chosen->rpe_m ? chosen->rpe_m->count : 0;
  add_statistics("rpe_", "m", chosen->rpe_m, json);
  add_statistics("rpe_", "deg", chosen->rpe_deg, json);
}

Json evaluated_json(const EvaluateArguments& arguments, const Trajectory& reference,
                    const Evaluated& evaluated) {
  const auto& [path, estimate, result] = evaluated;
  Json json;
  json["estimate"] = path;
  json["reference"] = arguments.reference;
  json["status"] = status_word(result.status);
  json["pairs"] = result.pairs.size();
  json["estimate_poses"] = estimate.size();
  json["reference_poses"] = reference.size();
  json["max_gap_s"] = arguments.options.max_gap_s;
  json["alignment"] = arguments.align;
  if (result.status == EvaluationStatus::not_alignable)
    json["alignment_status"] = word_for(result.absolute.status);
  if (result.status != EvaluationStatus::ok) return json;
  add_similarity(result.absolute.reference_from_estimate, json);
  add_statistics("ate_", "m", result.absolute.ate_m, json);
  add_statistics("ate_", "deg", result.absolute.ate_deg, json);
  json["ate_percentiles"] = percentiles_json(result.errors);
  json["queries"] = arguments.queries ? Json(*arguments.queries) : Json();
  json["within"] = within_json(arguments, reference, evaluated);
  add_chosen_rpe(arguments, result, json);
  json["se3"] = absolute_json(result.se3);
  json["sim3"] = absolute_json(result.sim3);
  json["rpe"] = Json::array();
  for (const auto& relative : result.relative) json["rpe"].push_back(relative_json(relative));
  json["drift"] = drift_json(result.drift);
  return json;
}

}  // namespace

void print_evaluations_json(const Evaluations& evaluations) {
  Json all = Json::array();
  for (const auto& evaluated : evaluations.estimates)
    all.push_back(evaluated_json(evaluations.arguments, evaluations.reference, evaluated));
  fmt::print("{}\n", (all.size() == 1 ? all[0] : Json{{"estimates", all}}).dump(2));
}

}  // namespace cairn::app
