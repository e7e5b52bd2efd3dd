// SPDX-License-Identifier: Apache-2.0
#include "localize_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/core/text.h"
#include "common.h"
#include "map_pictures.h"

namespace cairn::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr const char* kTimes = "times";
constexpr std::array<const char*, 6> kAxes{"rx", "ry", "rz", "x", "y", "z"};

/// Of six numbers, rotations in degrees and the position in metres.
std::string columns(const char* name, const char* of_rotation, const char* of_position) {
  std::string text;
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    text += fmt::format(",{}_{}_{}", name, kAxes[i], i < 3 ? of_rotation : of_position);
  return text;
}

std::string format_header() {
  std::string text =
      "frame,stamp_s,file,verdict,reason,tx_m,ty_m,tz_m,qx,qy,qz,qw,matches,inliers,independent_inliers,"
      "cells_of_16,rms_px,variance_factor,from_prior,gdop_m_per_px";
  text += columns("dop", "deg_per_px", "m_per_px");
  text += columns("std", "deg", "m");
  text += columns("protection", "deg", "m");
  for (std::size_t i = 0; i < kAxes.size(); ++i)
    for (std::size_t k = i; k < kAxes.size(); ++k) text += fmt::format(",cov_{}_{}", kAxes[i], kAxes[k]);
  return text + "\n";
}

std::string format_six(const Vector6d& values) {
  std::string text;
  for (int i = 0; i < 6; ++i) text += fmt::format(",{:.6g}", values[i] * (i < 3 ? kDegrees : 1.0));
  return text;
}

std::string format_pose(const Localization& found) {
  const WorldFromCamera pose = found.camera_from_world.inverse();
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format(",{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", t.x(), t.y(), t.z(), q.x(), q.y(),
                     q.z(), q.w());
}

std::string format_quality(const Localization& found) {
  const Precision& precision = found.precision;
  std::string text = fmt::format(",{},{},{},{},{:.4g},{:.4g},{},{:.6g}", found.matches.size(),
                                 found.inliers.size(), found.independent, found.cells, found.rms_px,
                                 found.variance_factor, found.from_prior ? 1 : 0, precision.gdop);
  const Vector6d std = precision.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  text += format_six(precision.dilution) + format_six(std) + format_six(precision.protection);
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k) text += fmt::format(",{:.9g}", precision.covariance(i, k));
  return text;
}

std::string format_row(const LocalizedImage& image) {
  const Localization& found = image.found;
  std::string text = fmt::format("{},{},{},{},{}", image.position, format_stamp(image.stamp_ns), image.file,
                                 to_string(found.verdict), to_string(found.weakness));
  if (found.found()) return text + format_pose(found) + format_quality(found) + "\n";
  constexpr std::size_t kPoseColumns = 7, kQualityColumns = 7 + 3 * 6 + 21;
  return text + std::string(kPoseColumns, ',') + fmt::format(",{}", found.matches.size()) +
         std::string(kQualityColumns, ',') + "\n";
}

struct Counts {
  std::size_t good = 0, weak = 0, none = 0;
  std::map<std::string_view, std::size_t> reasons;
};

Counts count(const std::vector<LocalizedImage>& images) {
  Counts counts;
  for (const LocalizedImage& image : images) {
    counts.good += image.found.verdict == Verdict::good ? 1 : 0;
    counts.weak += image.found.verdict == Verdict::weak ? 1 : 0;
    counts.none += image.found.verdict == Verdict::none ? 1 : 0;
    if (image.found.verdict == Verdict::weak) ++counts.reasons[to_string(image.found.weakness)];
  }
  return counts;
}

/// Nothing if no image has the value.
template <class ValueOf>
std::optional<double> median(const std::vector<LocalizedImage>& images, const ValueOf& value_of) {
  std::vector<double> values;
  for (const LocalizedImage& image : images)
    if (const std::optional<double> value = value_of(image)) values.push_back(*value);
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_ms(const std::vector<LocalizedImage>& images, double LocalizedImage::*seconds) {
  const auto value = [&](const LocalizedImage& image) { return std::optional(image.*seconds); };
  return 1e3 * median(images, value).value_or(0);
}

std::optional<double> median_inliers(const std::vector<LocalizedImage>& images) {
  return median(images, [](const LocalizedImage& image) {
    return image.found.found() ? std::optional(static_cast<double>(image.found.inliers.size()))
                               : std::nullopt;
  });
}

/// The largest standard deviation of the position along an axis by noise alone, of the images with a pose.
std::optional<double> median_std(const std::vector<LocalizedImage>& images) {
  return median(images, [](const LocalizedImage& image) -> std::optional<double> {
    if (!image.found.found()) return std::nullopt;
    return std::sqrt(image.found.precision.covariance.diagonal().tail<3>().maxCoeff());
  });
}

/// The largest protection level of the position along an axis, of the images with a pose.
std::optional<double> median_protection(const std::vector<LocalizedImage>& images) {
  return median(images, [](const LocalizedImage& image) -> std::optional<double> {
    if (!image.found.found()) return std::nullopt;
    return image.found.precision.protection.tail<3>().maxCoeff();
  });
}

nlohmann::ordered_json json_of(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nullptr;
}

/// What is said of poses, if there are any. The covariance knows noise alone, so that is what is said of it.
void print_precision(const std::vector<LocalizedImage>& images) {
  const auto inliers = median_inliers(images), std_m = median_std(images);
  if (!inliers || !std_m) return;
  fmt::print("inliers      {:.0f} in the median\n", *inliers);
  fmt::print(
      "position     {:.2g} cm by noise alone (standard deviation), protection level {:.2g} cm (medians);\n",
      100 * *std_m, 100 * median_protection(images).value_or(0));
  fmt::print("             errors that the whole map has in common are in neither\n");
}

nlohmann::ordered_json to_json(const LocalizedImage& image) {
  const Localization& found = image.found;
  nlohmann::ordered_json json{{"frame", image.position},
                              {"stamp_s", format_stamp(image.stamp_ns)},
                              {"file", image.file},
                              {"verdict", to_string(found.verdict)},
                              {"reason", to_string(found.weakness)}};
  if (!found.found()) return json;
  const WorldFromCamera pose = found.camera_from_world.inverse();
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  json["position_m"] = {t.x(), t.y(), t.z()};
  json["quaternion_xyzw"] = {q.x(), q.y(), q.z(), q.w()};
  json["inliers"] = found.inliers.size();
  json["gdop_m_per_px"] = found.precision.gdop;
  const auto& protection = found.precision.protection;
  json["protection_m"] = {protection[3], protection[4], protection[5]};
  return json;
}

}  // namespace

std::string describe_stamps(const Sequence& sequence) {
  if (sequence.has_times) return kTimes;
  if (sequence.format == "images")
    return "positions of the images in their folder, from 0: they have no times";
  return fmt::format("file numbers / {:g}: the images have no times", sequence.calibration.stamp_rate_hz());
}

std::string describe_camera(const Camera& camera, const QueryCamera& observed) {
  std::string size = fmt::format("{}x{} pixels", camera.width, camera.height);
  if (camera.width == observed.width && camera.height == observed.height) return size;
  return fmt::format("{}, scaled to {}x{}: to the map's pixels per radian", size, observed.width,
                     observed.height);
}

std::string format_localization_csv(const std::vector<LocalizedImage>& images,
                                    const LocalizeSummary& summary) {
  std::string text =
      "# Poses are world_from_camera. Axes of dop, std, protection (exceeded with probability 1e-3) and cov "
      "are the camera's: x right, y down, z forward; rx ry rz are rotations about them. cov in radians and "
      "metres: of the left perturbation (rx ry rz x y z) of camera_from_world. std, protection and cov know "
      "noise alone, not the errors that the whole map has in common. Pixels are those of images of " +
      summary.camera + ". stamp_s: " + summary.stamps + ".\n" + format_header();
  for (const LocalizedImage& image : images) text += format_row(image);
  return text;
}

std::string format_trajectory(const std::vector<LocalizedImage>& images, const LocalizeSummary& summary) {
  Trajectory trajectory;
  for (const LocalizedImage& image : images)
    if (image.found.found()) trajectory.push_back({image.stamp_ns, image.found.camera_from_world.inverse()});
  std::string text = format_tum_trajectory(trajectory);
  if (summary.stamps == kTimes) return text;
  return fmt::format("# t: {}; localization.csv has the names of the files\n{}", summary.stamps, text);
}

std::string format_localize_json(const std::vector<LocalizedImage>& images, const LocalizeSummary& summary) {
  const Counts counts = count(images);
  nlohmann::ordered_json json;
  json["cairn"] = CAIRN_VERSION;
  json["map"] = summary.map;
  json["sequence"] = summary.sequence;
  json["stamps"] = summary.stamps;
  json["camera"] = summary.camera;
  json["images"] = {{"total", summary.images},
                    {"good", counts.good},
                    {"weak", counts.weak},
                    {"none", counts.none},
                    {"unreadable", summary.unreadable.size()}};
  json["weak_because"] = nlohmann::ordered_json::object();
  for (const auto& [reason, number] : counts.reasons) json["weak_because"][std::string(reason)] = number;
  json["stopped"] = summary.stopped;
  json["median_inliers"] = json_of(median_inliers(images));
  json["median_std_m"] = json_of(median_std(images));
  json["median_protection_m"] = json_of(median_protection(images));
  json["threads"] = summary.threads;
  json["seconds"] = {{"open", summary.open_seconds}, {"total", summary.total_seconds}};
  json["median_ms"] = {{"features", median_ms(images, &LocalizedImage::feature_seconds)},
                       {"localize", median_ms(images, &LocalizedImage::localize_seconds)}};
  json["peak_memory_mb"] = peak_memory_mb();
  json["results"] = nlohmann::ordered_json::array();
  for (const LocalizedImage& image : images) json["results"].push_back(to_json(image));
  return json.dump(2) + "\n";
}

void print_localize_summary(const std::vector<LocalizedImage>& images, const LocalizeSummary& summary) {
  const Counts counts = count(images);
  fmt::print("images       {}: {} good, {} weak, {} not found\n", images.size(), counts.good, counts.weak,
             counts.none);
  fmt::print("camera       {}\n", summary.camera);
  if (summary.stamps != kTimes) fmt::print("stamps       {}\n", summary.stamps);
  for (const auto& [reason, number] : counts.reasons) fmt::print("  weak       {}: {}\n", reason, number);
  if (!summary.unreadable.empty()) fmt::print("unreadable   {} images, skipped\n", summary.unreadable.size());
  if (summary.stopped) fmt::print("stopped      after {} of {} images\n", images.size(), summary.images);
  print_precision(images);
  fmt::print("time         map opened in {:.3f} s; {:.1f} ms features and {:.1f} ms localisation an image\n",
             summary.open_seconds, median_ms(images, &LocalizedImage::feature_seconds),
             median_ms(images, &LocalizedImage::localize_seconds));
  fmt::print("memory       {:.0f} MB at most\n", peak_memory_mb());
  fmt::print("picture      {}/{}, the poses in the map from above\n", summary.output, kMapPicture);
  fmt::print("written to   {}\n", summary.output);
}

}  // namespace cairn::app
