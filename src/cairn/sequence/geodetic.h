// SPDX-License-Identifier: Apache-2.0
// Private to this room.
#pragma once

#include "cairn/sequence/recorded_poses.h"

namespace cairn {

/// Geodetic poses become poses in metres east, north and up of the origin: places through the earth's centre,
/// exact at any distance; rotations and covariances are turned from east, north, up at each place to those at
/// the origin (WGS 84).
void move_to_origin(const GeodeticOrigin& origin, RecordedPoses& recorded);

/// Metres between two places (latitude and longitude in degrees, height in metres) straight through the
/// earth.
[[nodiscard]] double geodetic_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Whether a place is 0 north and 0 east, which receivers write before they have a fix.
[[nodiscard]] bool is_without_fix(const Eigen::Vector3d& place);

}  // namespace cairn
