// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/sequence/listed_frames.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace cairn::testkit {

Sequence sequence_of(const char* format, const std::vector<std::int64_t>& numbers, double rate_hz) {
  Sequence sequence;
  sequence.folder = "recording";
  sequence.format = format;
  sequence.calibration.rate_hz = rate_hz;
  sequence.calibration_source = "camera.yaml";
  for (const std::int64_t number : numbers) {
    const std::int64_t stamp_ns = std::llround(1e9 * static_cast<double>(number) / rate_hz);
    sequence.frames.push_back({stamp_ns, number, {}, {}, {}, sequence.listed++});
  }
  return sequence;
}

Rigid3 forward_camera_on_frd() {
  return {Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), {2, 0.5, -1}};
}

Rigid3 forward_camera_on_flu() {
  return {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {2, -0.5, 1}};
}

Eigen::Vector3d earth_centred(double latitude_deg, double longitude_deg, double height_m) {
  constexpr double kEquator = 6378137.0, kFlattening = 1 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  const double lat = latitude_deg * std::numbers::pi / 180, lon = longitude_deg * std::numbers::pi / 180;
  const double normal = kEquator / std::sqrt(1 - kEccentricity2 * std::sin(lat) * std::sin(lat));
  return {(normal + height_m) * std::cos(lat) * std::cos(lon),
          (normal + height_m) * std::cos(lat) * std::sin(lon),
          (normal * (1 - kEccentricity2) + height_m) * std::sin(lat)};
}

Eigen::Matrix3d earth_from_enu(double latitude_deg, double longitude_deg) {
  const double lat = latitude_deg * std::numbers::pi / 180, lon = longitude_deg * std::numbers::pi / 180;
  Eigen::Matrix3d m;
  m.col(0) = Eigen::Vector3d(-std::sin(lon), std::cos(lon), 0);
  m.col(1) = Eigen::Vector3d(-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat));
  m.col(2) = Eigen::Vector3d(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  return m;
}

}  // namespace cairn::testkit
