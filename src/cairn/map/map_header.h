// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cairn/features/features.h"
#include "cairn/geometry/geodetic.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// What the descriptors of a map are called, how they are compared, and how long one is.
struct DescriptorKind {
  std::string name = "ORB";  ///< as in FeatureOptions
  Norm norm = Norm::hamming;
  std::uint32_t bytes = 0;  ///< 0 where no descriptor has been seen yet
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
