// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/geodetic.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"

namespace cairn {

void move_to_origin(const GeodeticOrigin& origin, RecordedPoses& recorded) {
  require(recorded.geodetic, "the poses are geodetic");
  const GeographicLib::LocalCartesian local(origin.latitude_deg, origin.longitude_deg, origin.height_m);
  std::vector<double> rows(9);  // origin's east, north, up from those at the place
  for (RecordedPose& pose : recorded.poses) {
    Eigen::Vector3d& place = pose.place;
    local.Forward(place.x(), place.y(), place.z(), place.x(), place.y(), place.z(), rows);
    const Eigen::Matrix3d turn = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
    pose.rotation = (Eigen::Quaterniond(turn) * pose.rotation).normalized();
    pose.place_covariance = propagate_covariance(turn, pose.place_covariance);
    pose.rotation_covariance = propagate_covariance(turn, pose.rotation_covariance);
  }
  recorded.geodetic = false;
}

double geodetic_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const auto earth_centred = [](const Eigen::Vector3d& place) {
    Eigen::Vector3d point;
    GeographicLib::Geocentric::WGS84().Forward(place.x(), place.y(), place.z(), point.x(), point.y(),
                                               point.z());
    return point;
  };
  return (earth_centred(a) - earth_centred(b)).norm();
}

bool is_without_fix(const Eigen::Vector3d& place) {
  constexpr double kRounding = 1e-7;  // degrees, a centimetre
  return std::abs(place.x()) < kRounding && std::abs(place.y()) < kRounding;
}

}  // namespace cairn
