// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cairn/report/json_pieces.h"
#include "cairn/report/stereo_calibration.h"
#include "cairn/report/text_builder.h"
#include "cairn/report/text_table.h"

namespace cairn {
namespace {

std::string finding_words(const Quantity& quantity) {
  const char* const words = to_string(quantity.finding);
  if (quantity.finding != Finding::off) return words;
  return fmt::format("{}, {}", words, quantity.is_written ? "corrected" : "not corrected");
}

std::string table_of(const std::vector<Quantity>& quantities) {
  std::vector<TableRow> rows{{"quantity", "found", "std", "unit", "finding"}};
  const auto number = [](const Quantity& quantity, double value) {
    return quantity.finding == Finding::undetermined ? std::string("-") : fmt::format("{:.4f}", value);
  };
  for (const Quantity& quantity : quantities)
    rows.push_back({quantity.name, number(quantity, quantity.value), number(quantity, quantity.sigma),
                    quantity.unit, finding_words(quantity)});
  return format_table(rows);
}

/// Adds why quantities are undetermined, one line for those of the same reason.
void add_reasons(const std::vector<Quantity>& quantities, TextBuilder& text) {
  for (std::size_t i = 0; i < quantities.size();) {
    std::string names = quantities[i].name;
    std::size_t next = i + 1;
    while (next < quantities.size() && !quantities[i].why.empty() &&
           quantities[next].why == quantities[i].why)
      names += ", " + quantities[next++].name;
    if (!quantities[i].why.empty()) text.add("{}: undetermined: {}\n", names, quantities[i].why);
    i = next;
  }
}

/// Says what to do about a delay of depth images, for which a calibration has no place.
void add_delay_advice(const std::vector<Quantity>& quantities, TextBuilder& text) {
  for (const Quantity& quantity : quantities)
    if (quantity.name == "depth delay" && quantity.finding == Finding::off)
      text.add("depth delay: add {:.4f} s to the stamps of the depth images\n", quantity.value);
}

/// Says what to do about the time offset and the factor of lengths, which are not written by themselves.
void add_advice(const CalibrationSummary& summary, TextBuilder& text) {
  const auto& poses = summary.result.poses;
  if (!poses || !summary.given) return;
  const double offset = summary.given->time_offset_s + poses->value[time_term];
  if (poses->is_off(time_term) && summary.given->is_by_frame)
    text.add("time offset: the poses belong to frames by their order; give them with stamps, {:.4f} s {}\n",
             std::abs(offset), offset < 0 ? "earlier" : "later");
  else if (poses->is_off(time_term))
    text.add("time offset: give --pose-offset {:.4f} to the commands that read --poses\n", offset);
  const bool has_factor = poses->is_off(scale_term) && !summary.result.quantities.empty();
  for (const Quantity& quantity : summary.result.quantities)
    if (has_factor && quantity.name.ends_with(" factor") && !quantity.is_written)
      text.add("{}: corrected only with --apply-baseline\n", quantity.name);
  for (const Quantity& quantity : summary.result.quantities)
    if (quantity.finding == Finding::off && !quantity.is_written && quantity.unit != "s" &&
        !quantity.unit.empty())
      text.add("{}: not corrected, as the calibration has no place for it: the poses are the camera's own\n",
               quantity.name);
}

Json quantity_json(const Quantity& quantity) {
  Json json{{"name", quantity.name},
            {"value", quantity.value},
            {"sigma", quantity.sigma},
            {"unit", quantity.unit},
            {"finding", to_string(quantity.finding)},
            {"written", quantity.is_written}};
  if (!quantity.why.empty()) json["why"] = quantity.why;
  return json;
}

Json poses_json(const PoseCalibration& poses, const GivenPath& given) {
  constexpr double kDegrees = 57.29577951308232;
  return {{"source", given.source.string()},
          {"format", given.format},
          {"of_body", given.is_of_body},
          {"stretches", poses.stretches},
          {"stretch_s", poses.stretch_s},
          {"turn_deg", poses.turn_deg},
          {"path_m", poses.path_m},
          {"rotation_scatter_deg", json_of(Eigen::Vector3d(kDegrees * poses.scatter.head<3>()))},
          {"translation_scatter_m", json_of(Eigen::Vector3d(poses.scatter.tail<3>()))},
          {"pose_offset_s", given.time_offset_s + (poses.is_off(time_term) ? poses.value[time_term] : 0)}};
}

}  // namespace

std::string format_calibration_text(const CalibrationSummary& summary) {
  const CalibrationResult& result = summary.result;
  TextBuilder text;
  text.add("frames       {}, {} tracked{}{}\n", result.frames, result.tracked,
           result.unreadable > 0 ? fmt::format(", {} unreadable", result.unreadable) : "",
           result.stopped ? ", stopped before the end" : "");
  if (result.poses && summary.given)
    text.add("poses        {} ({}), {} motions of {:.1f} s compared, {:.1f} m, {:.0f} deg\n",
             summary.given->source.string(), summary.given->format, result.poses->stretches,
             result.poses->stretch_s, result.poses->path_m, result.poses->turn_deg);
  else if (summary.given)
    text.add("poses        {} ({}), not compared\n", summary.given->source.string(), summary.given->format);
  else
    text.add("poses        none: baseline, time offset, boresight and lever arm need --poses\n");
  const std::string pair =
      describe(StereoCalibrationFigures{result.rows, result.rows_applied, result.disparities});
  if (!pair.empty()) text.add("{}\n", pair);
  text.append(table_of(result.quantities));
  add_reasons(result.quantities, text);
  add_delay_advice(result.quantities, text);
  add_advice(summary, text);
  const bool is_corrected = std::any_of(result.quantities.begin(), result.quantities.end(),
                                        [](const Quantity& quantity) { return quantity.is_written; });
  if (!summary.output.empty())
    text.add("written to   {}{}\n", summary.output,
             is_corrected ? "" : "; nothing was corrected, it is the calibration as stated");
  return text.take();
}

std::string format_calibration_json(const CalibrationSummary& summary) {
  const CalibrationResult& result = summary.result;
  Json quantities = Json::array();
  for (const Quantity& quantity : result.quantities) quantities.push_back(quantity_json(quantity));
  Json json{{"frames", result.frames},
            {"tracked", result.tracked},
            {"unreadable", result.unreadable},
            {"stopped", result.stopped},
            {"quantities", quantities},
            {"stereo_calibration",
             to_json(StereoCalibrationFigures{result.rows, result.rows_applied, result.disparities})}};
  json["poses"] = result.poses && summary.given ? poses_json(*result.poses, *summary.given) : Json(nullptr);
  json["output"] = summary.output.empty() ? Json(nullptr) : Json(summary.output);
  return format_document(json);
}

}  // namespace cairn
