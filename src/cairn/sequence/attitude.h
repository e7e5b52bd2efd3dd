// SPDX-License-Identifier: Apache-2.0
// Private to this room.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cairn {

/// Holds the angles of a body, radians: reference_from_body = Rz(yaw) Ry(pitch) Rx(roll). With z up and x
/// east, yaw counts counter-clockwise from east; with z down and x north it is the heading, clockwise from
/// north.
struct Attitude {
  double roll = 0, pitch = 0, yaw = 0;
};

/// Computes reference_from_body.
[[nodiscard]] Eigen::Quaterniond rotation_of(const Attitude& attitude);

/// Computes the matrix B with w = B * (droll, dpitch, dyaw), to first order: the small rotation w about the
/// axes of the reference by which the body rotates when its angles change. Its columns are the axes of roll,
/// pitch and yaw.
[[nodiscard]] Eigen::Matrix3d turn_by_angles(const Attitude& attitude);

/// Returns the rotation from north, east, down (surveyors' axes) to east, north, up (the world's).
[[nodiscard]] Eigen::Quaterniond enu_from_ned();

}  // namespace cairn
