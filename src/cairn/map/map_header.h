// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cairn/features/features.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// What the descriptors of a map are called, how they are compared, and how long one is.
struct DescriptorKind {
  std::string name = "ORB";  ///< as in FeatureOptions
  Norm norm = Norm::hamming;
  std::uint32_t bytes = 0;  ///< 0 where no descriptor has been seen yet
};

/// A place on the Earth (WGS 84) that is the origin of a map's world, whose axes point east, north and up.
struct GeodeticOrigin {
  double latitude_deg = 0;   ///< -90 to 90
  double longitude_deg = 0;  ///< -180 to 180
  double height = 0;         ///< metres above the ellipsoid
  bool operator==(const GeodeticOrigin&) const = default;
};

/// What is true of a whole map.
struct MapHeader {
  Rig rig;                    ///< that its observations are of
  int width = 0, height = 0;  ///< pixels of its images; 0 where not known
  DescriptorKind descriptor;
  std::string world = "camera of the first keyframe";  ///< what frame its poses and points are in, in words
  std::optional<GeodeticOrigin> origin;                ///< of a georeferenced world
  std::string settings;                                ///< of the run that made it, for people; any text
};

}  // namespace cairn
