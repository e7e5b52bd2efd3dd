// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "cairn/core/text.h"
#include "cairn/report/covariance_columns.h"
#include "cairn/report/localization_report.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::array<const char*, 6> kAxes{"rx", "ry", "rz", "x", "y", "z"};
constexpr std::size_t kAbsoluteColumns = 6 + 21;

/// Returns the names of six columns, rotations first.
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
  text += format_covariance_names("cov_");
  text += columns("abs_std", "deg", "m");
  text += format_covariance_names("abs_cov_");
  return text + "\n";
}

Vector6d deviations_of(const Matrix6d& covariance) {
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
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
  text += format_six(precision.dilution) + format_six(deviations_of(precision.covariance)) +
          format_six(precision.protection) + format_covariance_values(precision.covariance);
  if (!precision.absolute) return text + std::string(kAbsoluteColumns, ',');
  return text + format_six(deviations_of(*precision.absolute)) +
         format_covariance_values(*precision.absolute);
}

std::string format_row(const LocalizedImage& image) {
  const Localization& found = image.found;
  std::string text = fmt::format("{},{},{},{},{}", image.position, format_stamp(image.stamp_ns), image.file,
                                 to_string(found.verdict), to_string(found.weakness));
  if (found.found()) return text + format_pose(found) + format_quality(found) + "\n";
  constexpr std::size_t kPoseColumns = 7, kQualityColumns = 7 + 3 * 6 + 21 + kAbsoluteColumns;
  return text + std::string(kPoseColumns, ',') + fmt::format(",{}", found.matches.size()) +
         std::string(kQualityColumns, ',') + "\n";
}

}  // namespace

std::string format_localization_csv(const std::vector<LocalizedImage>& images,
                                    const LocalizationSummary& summary) {
  std::string text =
      "# Poses are world_from_camera. Axes of dop, std, protection (exceeded with probability 1e-3) and cov "
      "are the camera's: x right, y down, z forward; rx ry rz are rotations about them. cov in radians and "
      "metres: of the left perturbation (rx ry rz x y z) of camera_from_world. std, protection and cov are "
      "within the map, abs_std and abs_cov in the world of the poses that made it; empty: not known. Pixels "
      "are those of images of " +
      summary.camera + ". stamp_s: " + summary.stamps + ".\n" + format_header();
  for (const LocalizedImage& image : images) text += format_row(image);
  return text;
}

}  // namespace cairn
