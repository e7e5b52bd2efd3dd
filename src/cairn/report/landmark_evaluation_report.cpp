// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_evaluation_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/report/consistency_report.h"
#include "cairn/report/coverage_plot.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/ratio.h"
#include "cairn/report/text_builder.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

/// Returns the range of a class of distances: "5 to 10 m", "above 80 m".
std::string distance_name(const LandmarkClass& one) {
  return std::isinf(one.to) ? fmt::format("above {:g} m", one.from)
                            : fmt::format("{:g} to {:g} m", one.from, one.to);
}

/// Returns the range of a class of numbers: "5 to 8 observations", "17 or more observations".
std::string observations_name(const LandmarkClass& one) {
  return std::isinf(one.to) ? fmt::format("{:g} or more observations", one.from)
                            : fmt::format("{:g} to {:g} observations", one.from, one.to - 1);
}

std::vector<ConsistencyRow> rows_of(const LandmarkEvaluation& result) {
  std::vector<ConsistencyRow> rows;
  const auto add = [&](const std::string& name, const std::optional<ErrorConsistency>& consistency) {
    if (consistency) rows.push_back({name, *consistency, ErrorUnit::metres});
  };
  add("all", result.all);
  add("on one surface", result.on_surface);
  add("at an edge", result.at_edge);
  for (const LandmarkClass& one : result.by_distance) add(distance_name(one), one.consistency);
  for (const LandmarkClass& one : result.by_observations) add(observations_name(one), one.consistency);
  return rows;
}

void add_counts(const LandmarkEvaluation& result, TextBuilder& text) {
  text.add("judged      {} of {} landmarks ({:.1f} %), {} of them at edges\n", result.judged,
           result.landmarks, share_percent(result.judged, result.landmarks), result.at_edges);
  const std::pair<std::size_t, const char*> others[] = {
      {result.without_covariance, "without a covariance"},
      {result.undetermined, "with an infinite covariance"},
      {result.without_truth, "where the truth shows nothing"},
      {result.in_other_components, "in other components of the map"}};
  for (const auto& [count, what] : others)
    if (count > 0) text.add("not judged  {} {}\n", count, what);
}

/// Returns the classes with their ranges, whose keys end with `unit`.
Json classes_json(const std::vector<LandmarkClass>& classes, const std::string& unit) {
  Json json = Json::array();
  for (const LandmarkClass& one : classes) {
    Json of_class = consistency_json(one.consistency, ErrorUnit::metres);
    of_class["from" + unit] = one.from;
    of_class["below" + unit] = std::isinf(one.to) ? Json() : Json(one.to);
    json.push_back(of_class);
  }
  return json;
}

}  // namespace

std::string format_landmark_evaluation_text(const LandmarkEvaluationReport& report) {
  const LandmarkEvaluation& result = report.result;
  require(result.alignment_status == AlignmentStatus::ok, "the map is aligned");
  TextBuilder text;
  text.add("keyframes   {} in {}, {:.3f} m and {:.3f} deg from the truth (medians), alignment {}\n",
           result.keyframe_pairs, report.reference_path, result.keyframe_error_m, result.keyframe_error_deg,
           name_of(report.options.alignment));
  add_counts(result, text);
  if (!result.distances_m) return text.take();
  const ErrorStatistics& distances = *result.distances_m;
  text.add("distance from the true surface, cm: median {:.2f}, mean {:.2f}, rmse {:.2f}, largest {:.1f}\n\n",
           100 * distances.median, 100 * distances.mean, 100 * distances.rmse, 100 * distances.max);
  text.append(format_consistencies("along the surface's normal", "landmarks", rows_of(result)));
  return text.take();
}

std::string format_landmark_evaluation_json(const LandmarkEvaluationReport& report) {
  const LandmarkEvaluation& result = report.result;
  Json json;
  json["map"] = report.map_path;
  json["reference"] = report.reference_path;
  json["alignment"] = name_of(report.options.alignment);
  json["alignment_status"] = word_for(result.alignment_status);
  json["keyframes"] = result.keyframe_pairs;
  if (result.alignment_status != AlignmentStatus::ok) return format_document(json);
  add_similarity(result.truth_from_map, json);
  json["keyframe_error_median_m"] = result.keyframe_error_m;
  json["keyframe_error_median_deg"] = result.keyframe_error_deg;
  json["landmarks"] = result.landmarks;
  json["judged"] = result.judged;
  json["at_edges"] = result.at_edges;
  json["without_covariance"] = result.without_covariance;
  json["undetermined"] = result.undetermined;
  json["without_truth"] = result.without_truth;
  json["in_other_components"] = result.in_other_components;
  if (!result.distances_m) return format_document(json);
  const ErrorStatistics& distances = *result.distances_m;
  json["distance_from_surface_m"] = {{"median", distances.median},
                                     {"mean", distances.mean},
                                     {"rmse", distances.rmse},
                                     {"max", distances.max}};
  json["all"] = consistency_json(*result.all, ErrorUnit::metres);
  if (result.on_surface) json["on_one_surface"] = consistency_json(*result.on_surface, ErrorUnit::metres);
  if (result.at_edge) json["at_an_edge"] = consistency_json(*result.at_edge, ErrorUnit::metres);
  json["by_distance"] = classes_json(result.by_distance, "_m");
  json["by_observations"] = classes_json(result.by_observations, "");
  return format_document(json);
}

std::string draw_landmark_coverage(const LandmarkEvaluationReport& report) {
  const LandmarkEvaluation& result = report.result;
  require(result.all.has_value(), "a landmark was judged");
  CoveragePlot plot;
  plot.title = "Are the covariances of landmarks honest?";
  plot.subtitle = fmt::format("{} against {}, along the normals of the true surfaces, alignment {}",
                              short_name(report.map_path), short_name(report.reference_path),
                              name_of(report.options.alignment));
  plot.panels.push_back({"all landmarks", {{"all", result.all->report}}});
  if (result.on_surface) plot.panels[0].curves.push_back({"on one surface", result.on_surface->report});
  if (result.at_edge) plot.panels[0].curves.push_back({"at an edge", result.at_edge->report});
  CoveragePlot::Panel by_distance{"by the distance of the nearest camera", {}};
  for (const LandmarkClass& one : result.by_distance)
    by_distance.curves.push_back({distance_name(one), one.consistency.report});
  CoveragePlot::Panel by_observations{"by the number of observations", {}};
  for (const LandmarkClass& one : result.by_observations)
    by_observations.curves.push_back({observations_name(one), one.consistency.report});
  plot.panels.push_back(std::move(by_distance));
  plot.panels.push_back(std::move(by_observations));
  return draw_coverage_plot(plot);
}

}  // namespace cairn
