// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// Describes the origin of a georeferenced world on the Earth (WGS 84); the axes of the world are east, north
/// and up there.
struct GeodeticOrigin {
  double latitude_deg = 0;   ///< -90 to 90
  double longitude_deg = 0;  ///< -180 to 180
  double height_m = 0;       ///< above the ellipsoid
  bool operator==(const GeodeticOrigin&) const = default;
};

}  // namespace cairn
