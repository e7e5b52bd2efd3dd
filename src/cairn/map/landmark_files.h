// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/map/map.h"
#include "cairn/map/map_info.h"

namespace cairn {

/// A landmark in Point.bin.
struct StoredLandmark {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the point, square metres; 0: not known
  std::vector<std::uint32_t> descriptors;                ///< of its sightings: rows of Descriptor.bin
};

/// Descriptor.bin: row i shows sighting i.
struct StoredSightings {
  std::vector<Sighting> sightings;
  Descriptors descriptors;
};

/// Landmark i of `landmarks` has number i.
[[nodiscard]] std::string format_point_file(const std::vector<StoredLandmark>& landmarks);
[[nodiscard]] std::string format_descriptor_file(const StoredSightings& stored, const DescriptorKind& kind);

/// Point.bin or Descriptor.bin of the map in `folder`, as `info` announces it; the indices lie in their
/// ranges. InputError where the file is missing, damaged, of another version, not the one that was announced,
/// or holds impossible values.
[[nodiscard]] std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder,
                                                          const MapInfo& info);
[[nodiscard]] StoredSightings read_descriptor_file(const std::filesystem::path& folder, const MapInfo& info);

}  // namespace cairn
