// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/map/map.h"
#include "cairn/map_files/binary_file.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// A landmark in Point.bin.
struct StoredLandmark {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the point, square metres; 0: not known
  std::uint64_t first_row = 0;  ///< of Descriptor.bin: there and in the next rows are its observations
  std::uint32_t observations = 0;
};

/// Returns the landmark's standard deviation along the worst direction, metres; NaN if its covariance is not
/// known.
[[nodiscard]] double largest_std(const StoredLandmark& landmark);

/// Descriptor.bin: row i shows observation i.
struct StoredObservations {
  std::vector<ObservationRef> observations;
  Descriptors descriptors;
};

/// Bytes of a row of Descriptor.bin, and of a record of Point.bin.
[[nodiscard]] std::size_t observation_bytes(const DescriptorKind& kind);
constexpr std::size_t kLandmarkBytes = 112;
/// Where the records begin, and within a row of Descriptor.bin the descriptor.
constexpr std::size_t kPointBegin = 24, kDescriptorBegin = 32, kObservationHead = 16;
constexpr BinaryKind kPointKind{"CAIRNPNT", kMapVersion};
constexpr BinaryKind kDescriptorKind{"CAIRNDSC", kMapVersion};

/// Beginnings of the files for so many landmarks and observations; then come the records, in order.
[[nodiscard]] BinaryWriter begin_point_file(std::uint32_t landmarks, std::uint64_t observations);
[[nodiscard]] BinaryWriter begin_descriptor_file(const DescriptorKind& kind, std::uint64_t observations);
/// The landmark's point is finite, its covariance symmetric and without a NaN, its variances not negative.
void put_landmark(std::uint32_t number, const StoredLandmark& landmark, ByteWriter& writer);
/// `descriptor` has the kind's bytes.
void put_observation(const ObservationRef& observation, const Keypoint& keypoint,
                     const std::uint8_t* descriptor, const DescriptorKind& kind, ByteWriter& writer);

/// What a covariance in Point.bin can be: variances may be infinite, of a point that nothing determines.
[[nodiscard]] bool is_covariance(const Eigen::Matrix3d& matrix);

/// Point.bin or Descriptor.bin of the map in `folder`, as `info` announces it; the indices lie in their
/// ranges. InputError where the file is missing, damaged, of another version, not the one that was announced,
/// or holds impossible values.
[[nodiscard]] std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder,
                                                          const MapInfo& info);
[[nodiscard]] StoredObservations read_descriptor_file(const std::filesystem::path& folder,
                                                      const MapInfo& info);

}  // namespace cairn
