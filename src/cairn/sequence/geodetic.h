// SPDX-License-Identifier: Apache-2.0
// Private to this room.
#pragma once

#include "cairn/sequence/recorded_poses.h"

namespace cairn {

/// Converts geodetic poses to poses in metres east, north and up of the origin: positions through the earth's
/// centre, exact at any distance; rotations and covariances are rotated from east, north, up at each position
/// to those at the origin (WGS 84). Throws PreconditionError if the poses are not geodetic.
void move_to_origin(const GeodeticOrigin& origin, RecordedPoses& recorded);

/// Computes the distance of two positions (latitude and longitude in degrees, height in metres), metres
/// straight through the earth.
[[nodiscard]] double geodetic_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Tells whether a position is 0 north and 0 east, which receivers write before they have a fix.
[[nodiscard]] bool is_without_fix(const Eigen::Vector3d& place);

}  // namespace cairn
