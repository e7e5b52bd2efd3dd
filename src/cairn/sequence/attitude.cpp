// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/attitude.h"

#include <numbers>

namespace cairn {
namespace {

Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

}  // namespace

Eigen::Quaterniond rotation_of(const Attitude& attitude) {
  return (turn(attitude.yaw, Eigen::Vector3d::UnitZ()) * turn(attitude.pitch, Eigen::Vector3d::UnitY()) *
          turn(attitude.roll, Eigen::Vector3d::UnitX()))
      .normalized();
}

Eigen::Matrix3d turn_by_angles(const Attitude& attitude) {
  const Eigen::Quaterniond by_yaw = turn(attitude.yaw, Eigen::Vector3d::UnitZ());
  const Eigen::Quaterniond by_pitch = turn(attitude.pitch, Eigen::Vector3d::UnitY());
  Eigen::Matrix3d axes;
  axes.col(0) = by_yaw * (by_pitch * Eigen::Vector3d::UnitX());
  axes.col(1) = by_yaw * Eigen::Vector3d::UnitY();
  axes.col(2) = Eigen::Vector3d::UnitZ();
  return axes;
}

Eigen::Quaterniond enu_from_ned() {  // half a turn about the axis between north and east
  constexpr double kHalfOfSqrt2 = std::numbers::sqrt2 / 2;
  return {0, kHalfOfSqrt2, kHalfOfSqrt2, 0};
}

}  // namespace cairn
