// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/alignment_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/report/alignment_plot.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/text_builder.h"
#include "cairn/report/trajectory_words.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Returns three numbers with nine decimals; no -0.
std::string columns(const Eigen::Vector3d& values) {
  constexpr double kShown = 5e-10;
  std::string text;
  for (const double value : values) text += fmt::format(" {:13.9f}", std::abs(value) < kShown ? 0.0 : value);
  return text;
}

}  // namespace

std::string format_alignment_text(const AlignmentReport& report) {
  const Similarity3& map = report.alignment.target_from_source;
  const Eigen::Matrix3d R = map.rotation.toRotationMatrix();
  TextBuilder text;
  text.add("pairs      {}{}\n", report.pairs.size(),
           report.max_gap_s ? fmt::format(", stamps within {} s", *report.max_gap_s) : "");
  text.add("transform  reference = {}R * estimate + t, from the estimate's world to the reference's\n",
           report.with_scale ? "s * " : "");
  for (int row = 0; row < 3; ++row) text.add("{:<10}{}\n", row == 0 ? "R" : "", columns(R.row(row)));
  text.add("{:<10}{}  m\n", "t", columns(map.translation));
  if (report.with_scale) text.add("{:<10} {:13.9f}\n", "s", map.scale);
  text.add("angle      {:.6f} deg\n", kDegrees * rotation_angle(map.rotation));
  text.add("residual   {:.9f} m RMS before, {:.9f} m after\n", report.rms_before_m, report.alignment.rmse);
  return text.take();
}

std::string format_alignment_json(const AlignmentReport& report) {
  const AlignmentStatus status = report.alignment.status;
  Json json;
  json["status"] = report.pairs.empty() ? "no_pairs" : word_for(status);
  json["pairs"] = report.pairs.size();
  if (status != AlignmentStatus::ok) return format_document(json);
  const Similarity3& map = report.alignment.target_from_source;
  json["direction"] = "reference_from_estimate";
  json["rotation"] = rows_of(map.rotation.toRotationMatrix());
  add_similarity(map, json);
  json["with_scale"] = report.with_scale;
  json["rms_before_m"] = report.rms_before_m;
  json["rms_after_m"] = report.alignment.rmse;
  json["turn_uncertainty_deg"] = kDegrees * report.alignment.turn_uncertainty;
  return format_document(json);
}

std::string draw_alignment(const AlignmentReport& report) {
  AlignmentPlot plot;
  plot.title = fmt::format("{} pairs aligned by {}", report.pairs.size(), report.with_scale ? "sim3" : "se3");
  plot.subtitle = short_name(report.estimate_path);
  if (!report.reference_path.empty()) plot.subtitle += " onto " + short_name(report.reference_path);
  plot.before = fmt::format("before: {:.4g} m RMS", report.rms_before_m);
  plot.after = fmt::format("after: {:.4g} m RMS", report.alignment.rmse);
  for (const PosePair& pair : report.pairs) {
    plot.reference.push_back(pair.reference.translation);
    plot.estimate_before.push_back(pair.estimate.translation);
    plot.estimate_after.push_back(report.alignment.target_from_source * pair.estimate.translation);
  }
  return draw_alignment_plot(plot);
}

}  // namespace cairn
