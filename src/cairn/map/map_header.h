// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cairn/features/features.h"
#include "cairn/geometry/disparity_noise.h"
#include "cairn/geometry/geodetic.h"
#include "cairn/geometry/rig.h"
#include "cairn/geometry/stereo_correction.h"

namespace cairn {

/// Describes the descriptors of a map: their name, how they are compared, and their size.
struct DescriptorKind {
  std::string name = "ORB";  ///< as in FeatureOptions
  Norm norm = Norm::hamming;
  std::uint32_t bytes = 0;  ///< size of a descriptor; 0 if none has been seen yet
};

/// Holds what is true of a whole map.
struct MapHeader {
  Rig rig;                    ///< rig that the observations are of
  int width = 0, height = 0;  ///< size of the images, pixels; 0 if it is not known
  /// What was taken off the right images' rows and the disparities of a stereo pair; nullopt for nothing. An
  /// image of the same pair fits the map after the same correction.
  std::optional<StereoCorrection> right_correction;
  std::optional<DisparityNoise> depth_noise;  ///< of the RGB-D camera that made it; nullopt for others
  DescriptorKind descriptor;
  std::string world = "camera of the first keyframe";  ///< frame that poses and points are in, in words
  std::optional<GeodeticOrigin> origin;                ///< origin of a georeferenced world
  std::string settings;  ///< settings of the run that made it, for people; any text
};

}  // namespace cairn
