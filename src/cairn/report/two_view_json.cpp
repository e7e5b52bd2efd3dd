// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/report/json_pieces.h"
#include "cairn/report/two_view_figures.h"
#include "cairn/report/two_view_report.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Json to_json(const EssentialDecomposition& parts) {
  return {{"singular_values", json_of(parts.singular_values)},
          {"factors", {rows_of(parts.factors[0]), rows_of(parts.factors[1])}},
          {"factor_determinant", parts.factors[0].determinant() < 0 ? -1 : 1},
          {"R1", rows_of(parts.rotations[0])},
          {"R2", rows_of(parts.rotations[1])},
          {"t", json_of(parts.translation)}};
}

Json to_json(const RansacResult<Eigen::Matrix3d>& result) {
  Json json = {{"status", to_string(result.status)}, {"samples", result.iterations}};
  if (!result.found()) return json;
  json["inliers"] = result.inliers.size();
  json["log10_false_alarms"] = result.log10_false_alarms;
  json["matrix"] = rows_of(result.model);
  return json;
}

Json motions_json(const TwoViewResult& result) {
  Json motions = Json::array();
  for (const TwoViewMotion& motion : result.motions)
    motions.push_back({{"R", rows_of(motion.b_from_a.matrix3())},
                       {"t", json_of(motion.b_from_a.translation)},
                       {"in_front", motion.in_front},
                       {"parted", motion.parted}});
  return motions;
}

}  // namespace

std::string format_two_view_json(const TwoViewReport& report) {
  const TwoViewResult& result = report.result;
  Json json = {{"status", result.status == TwoViewStatus::ok ? "ok" : to_string(result.status)},
               {"keypoints", {report.a.features.keypoints.size(), report.b.features.keypoints.size()}},
               {"matches", report.pixels_in_a.size()},
               {"sigma_px", report.sigma_px},
               {"essential", to_json(result.essential)},
               {"homography", to_json(result.homography)}};
  if (result.essential.found() || result.homography.found()) {
    json["choice"] = to_string(result.choice.model);
    for (std::size_t i = 0; i < result.choice.gric.size(); ++i)
      json["gric"][std::string(to_string(static_cast<TwoViewModel>(i)))] = result.choice.gric[i];
    if (result.essential.found())
      json["decomposition"] = to_json(decompose_essential(result.essential.model));
    json["motions"] = motions_json(result);
    json["motion"] = {{"direction", "b_from_a"},
                      {"R", rows_of(result.b_from_a.matrix3())},
                      {"t", json_of(report.unit() * result.b_from_a.translation)},
                      {"angle_deg", kDegrees * rotation_angle(result.b_from_a.rotation)}};
  }
  if (report.scale)
    json["scale"] = {{"points", report.scale->points},
                     {"metres", report.scale->metres_per_unit},
                     {"spread", report.scale->relative_mad}};
  json["points"] = result.points.size();
  if (!result.points.empty()) json["rms_px"] = rms_px(report);
  return format_document(json);
}

std::string format_decomposition_json(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  Json json = {{"essential", rows_of(essential)}};
  json.update(to_json(parts));
  json["relative_distance"] = relative_distance(essential, parts);
  return format_document(json);
}

}  // namespace cairn
