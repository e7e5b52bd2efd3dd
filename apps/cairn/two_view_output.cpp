// SPDX-License-Identifier: Apache-2.0
#include "two_view_output.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace cairn::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr const char* kMotionNames[] = {"R1, t", "R1, -t", "R2, t", "R2, -t"};

std::string row_of(const Eigen::RowVector3d& row) {
  constexpr double kShown = 5e-16;  // what rounding leaves of 0
  std::string text;
  for (const double value : row) text += fmt::format(" {:12.6g}", std::abs(value) < kShown ? 0.0 : value);
  return text;
}

void print_matrix(const std::string& name, const Eigen::Matrix3d& matrix) {
  for (int i = 0; i < 3; ++i) fmt::print("{:<16}{}\n", i == 0 ? name : "", row_of(matrix.row(i)));
}

void print_vector(const std::string& name, const Eigen::Vector3d& vector) {
  fmt::print("{:<16}{}\n", name, row_of(vector.transpose()));
}

nlohmann::ordered_json json_of(const Eigen::Matrix3d& m) {
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

nlohmann::ordered_json json_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

nlohmann::ordered_json json_of(const EssentialDecomposition& parts) {
  return {{"singular_values", json_of(parts.singular_values)},
          {"factors", {json_of(parts.factors[0]), json_of(parts.factors[1])}},
          {"factor_determinant", parts.factors[0].determinant() < 0 ? -1 : 1},
          {"R1", json_of(parts.rotations[0])},
          {"R2", json_of(parts.rotations[1])},
          {"t", json_of(parts.translation)}};
}

void print_ransac(const char* name, const RansacResult<Eigen::Matrix3d>& result, std::size_t matches) {
  if (!result.found()) {
    fmt::print("{:<16} none of {} samples: {}\n", name, result.iterations, to_string(result.status));
    return;
  }
  fmt::print("{:<16} {} of {} matches agree, {} samples, 10^{:.0f} false alarms expected\n", name,
             result.inliers.size(), matches, result.iterations, result.log10_false_alarms);
}

nlohmann::ordered_json json_of(const RansacResult<Eigen::Matrix3d>& result) {
  nlohmann::ordered_json json = {{"status", to_string(result.status)}, {"samples", result.iterations}};
  if (!result.found()) return json;
  json["inliers"] = result.inliers.size();
  json["log10_false_alarms"] = result.log10_false_alarms;
  json["matrix"] = json_of(result.model);
  return json;
}

void print_choice(const TwoViewResult& result) {
  fmt::print("choice           {}: least GRIC of", to_string(result.choice.model));
  for (std::size_t i = 0; i < result.choice.gric.size(); ++i)
    fmt::print("{} {:.1f} ({})", i == 0 ? "" : ",", result.choice.gric[i],
               to_string(static_cast<TwoViewModel>(i)));
  fmt::print(", {} matches\n", result.choice.pairs);
}

void print_motions(const TwoViewResult& result) {
  for (std::size_t i = 0; i < result.motions.size(); ++i) {
    const TwoViewMotion& motion = result.motions[i];
    fmt::print("{:<16} {} of {} matches in front of both cameras{}\n", kMotionNames[i], motion.in_front,
               motion.parted, i == result.motion ? "  <- most" : "");
  }
}

void print_chosen(const TwoViewReport& report) {
  const Rigid3& b_from_a = report.result.b_from_a;
  fmt::print("motion           point in B = R * point in A + t, t in {}\n",
             report.scale && report.scale->points > 0 ? "metres" : "units of its length");
  print_matrix("R", b_from_a.matrix3());
  print_vector("t", report.unit() * b_from_a.translation);
  fmt::print("{:<16} {:.4f} deg\n", "angle", kDegrees * rotation_angle(b_from_a.rotation));
}

std::string scale_text(const MetricScale& scale) {
  if (scale.points == 0) return "not known: no point has a depth";
  return fmt::format("{:.6g} m between the cameras, median over {} points with depth, spread {:.2g} %",
                     scale.metres_per_unit, scale.points, 100 * scale.spread);
}

/// Root mean square over both views, pixels.
double rms_px(const TwoViewReport& report, double focal_px) {
  double sum = 0;
  for (const TwoViewPoint& point : report.result.points) sum += point.triangulated.squared_error;
  return focal_px * std::sqrt(sum / (2.0 * static_cast<double>(report.result.points.size())));
}

nlohmann::ordered_json json_of_motions(const TwoViewResult& result) {
  nlohmann::ordered_json motions = nlohmann::ordered_json::array();
  for (const TwoViewMotion& motion : result.motions)
    motions.push_back({{"R", json_of(motion.b_from_a.matrix3())},
                       {"t", json_of(motion.b_from_a.translation)},
                       {"in_front", motion.in_front},
                       {"parted", motion.parted}});
  return motions;
}

}  // namespace

void print_two_view(const TwoViewReport& report) {
  const TwoViewResult& result = report.result;
  for (const TimedFeatures* image : {&report.a, &report.b})
    fmt::print("{}  {} keypoints\n", image->path, image->features.keypoints.size());
  const std::size_t matches = report.pixels_in_a.size();
  fmt::print("matches          {}, standard deviation of a pixel {} px\n", matches, report.sigma_px);
  print_ransac("essential", result.essential, matches);
  print_ransac("homography", result.homography, matches);
  if (!result.essential.found() && !result.homography.found()) return;
  print_choice(result);
  if (result.essential.found())
    print_decomposition(result.essential.model, decompose_essential(result.essential.model));
  if (result.choice.model == TwoViewModel::homography) print_matrix("H", result.homography.model);
  if (result.choice.model != TwoViewModel::rotation) print_motions(result);
  print_chosen(report);
  if (report.scale) fmt::print("scale            {}\n", scale_text(*report.scale));
  if (!result.points.empty())
    fmt::print("points           {}, {:.3g} px RMS\n", result.points.size(), rms_px(report, report.focal_px));
}

void print_two_view_json(const TwoViewReport& report) {
  const TwoViewResult& result = report.result;
  nlohmann::ordered_json json = {
      {"status", result.status == TwoViewStatus::ok ? "ok" : to_string(result.status)},
      {"keypoints", {report.a.features.keypoints.size(), report.b.features.keypoints.size()}},
      {"matches", report.pixels_in_a.size()},
      {"sigma_px", report.sigma_px},
      {"essential", json_of(result.essential)},
      {"homography", json_of(result.homography)}};
  if (result.essential.found() || result.homography.found()) {
    json["choice"] = to_string(result.choice.model);
    for (std::size_t i = 0; i < result.choice.gric.size(); ++i)
      json["gric"][std::string(to_string(static_cast<TwoViewModel>(i)))] = result.choice.gric[i];
    if (result.essential.found())
      json["decomposition"] = json_of(decompose_essential(result.essential.model));
    json["motions"] = json_of_motions(result);
    json["motion"] = {{"direction", "b_from_a"},
                      {"R", json_of(result.b_from_a.matrix3())},
                      {"t", json_of(Eigen::Vector3d(report.unit() * result.b_from_a.translation))},
                      {"angle_deg", kDegrees * rotation_angle(result.b_from_a.rotation)}};
  }
  if (report.scale)
    json["scale"] = {{"points", report.scale->points},
                     {"metres", report.scale->metres_per_unit},
                     {"spread", report.scale->spread}};
  json["points"] = result.points.size();
  if (!result.points.empty()) json["rms_px"] = rms_px(report, report.focal_px);
  fmt::print("{}\n", json.dump(2));
}

std::string format_points(const TwoViewReport& report) {
  std::string csv = "u1,v1,u2,v2,x,y,z,angle_deg\n";
  for (const TwoViewPoint& point : report.result.points) {
    const auto pair = static_cast<std::size_t>(point.pair);
    const Eigen::Vector2d &p = report.pixels_in_a[pair], &q = report.pixels_in_b[pair];
    const Eigen::Vector3d x = report.unit() * point.triangulated.point_in_a;
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", p.x(), p.y(), q.x(), q.y(), x.x(), x.y(), x.z(),
                       kDegrees * point.triangulated.angle);
  }
  return csv;
}

Cloud cloud_of(const TwoViewReport& report) {
  Cloud cloud;
  for (const TwoViewPoint& point : report.result.points) {
    const Eigen::Vector2d& pixel = report.pixels_in_a[static_cast<std::size_t>(point.pair)];
    const std::uint8_t grey =
        report.a.image(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    const Eigen::Vector3f x = (report.unit() * point.triangulated.point_in_a).cast<float>();
    cloud.points.push_back({x.x(), x.y(), x.z(), grey, grey, grey});
  }
  return cloud;
}

double relative_distance(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  return (skew(parts.translation) * parts.rotations[0] - essential).norm() / essential.norm();
}

void print_decomposition(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  const bool mirrored = parts.factors[0].determinant() < 0;
  print_matrix("E", essential);
  print_vector("singular values", parts.singular_values);
  print_matrix("U W^T V^T", parts.factors[0]);
  print_matrix("U W V^T", parts.factors[1]);
  fmt::print("determinant      {}\n", mirrored ? "-1: a rotation is the negative of each, as -E is E's equal"
                                               : "1: these are the rotations");
  print_matrix("R1", parts.rotations[0]);
  print_matrix("R2", parts.rotations[1]);
  print_vector("t", parts.translation);
  print_vector("-t", -parts.translation);
  print_matrix("t^R1", skew(parts.translation) * parts.rotations[0]);
  print_matrix("-t^R2", skew(-parts.translation) * parts.rotations[1]);
}

void print_decomposition_json(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts) {
  nlohmann::ordered_json json = {{"essential", json_of(essential)}};
  json.update(json_of(parts));
  json["relative_distance"] = relative_distance(essential, parts);
  fmt::print("{}\n", json.dump(2));
}

}  // namespace cairn::app
