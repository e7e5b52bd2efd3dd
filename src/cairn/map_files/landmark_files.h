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

/// Holds a landmark as stored in Point.bin.
struct StoredLandmark {
  Eigen::Vector3d point_in_world = Eigen::Vector3d::Zero();
  /// Covariance of the point, square metres; 0: not known.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  std::uint64_t first_row = 0;  ///< first of the successive rows of Descriptor.bin with its observations
  std::uint32_t observations = 0;
};

/// Returns the landmark's standard deviation along the worst direction, metres; NaN if its covariance is not
/// known.
[[nodiscard]] double largest_std(const StoredLandmark& landmark);

/// Holds the contents of Descriptor.bin: row i of `descriptors` is of observation i.
struct StoredObservations {
  std::vector<ObservationRef> observations;
  Descriptors descriptors;
};

/// Returns the size of a row of Descriptor.bin, bytes.
[[nodiscard]] std::size_t observation_bytes(const DescriptorKind& kind);
/// Size of a record of Point.bin, bytes.
constexpr std::size_t kLandmarkBytes = 112;
/// Offsets, bytes: of the records in Point.bin and in Descriptor.bin, and of the descriptor in a row of
/// Descriptor.bin.
constexpr std::size_t kPointBegin = 24, kDescriptorBegin = 32, kObservationHead = 16;
constexpr BinaryKind kPointKind{"CAIRNPNT", kMapVersion};
/// Offset of the records of Noise.bin and the size of one, bytes.
constexpr std::size_t kNoiseBegin = 16, kNoiseBytes = 48;
constexpr BinaryKind kNoiseKind{"CAIRNNSE", kMapVersion};
constexpr BinaryKind kDescriptorKind{"CAIRNDSC", kMapVersion};

/// Returns the beginning of Point.bin; the records follow, in order (put_landmark).
[[nodiscard]] BinaryWriter begin_point_file(std::uint32_t landmarks, std::uint64_t observations);
/// Returns the beginning of Descriptor.bin; the rows follow, in order (put_observation).
[[nodiscard]] BinaryWriter begin_descriptor_file(const DescriptorKind& kind, std::uint64_t observations);
/// Appends a record of Point.bin. Throws PreconditionError unless the point is finite, and the covariance
/// symmetric, without NaN and without negative variances.
void put_landmark(std::uint32_t number, const StoredLandmark& landmark, ByteWriter& writer);
/// Returns the beginning of Noise.bin; the records follow, in order (put_noise).
[[nodiscard]] BinaryWriter begin_noise_file(std::uint32_t landmarks);
/// Appends a record of Noise.bin. Throws PreconditionError unless the covariance is symmetric, without NaN
/// and without negative variances.
void put_noise(const Eigen::Matrix3d& covariance, ByteWriter& writer);
/// Appends a row of Descriptor.bin; `descriptor` has as many bytes as `kind` says.
void put_observation(const ObservationRef& observation, const Keypoint& keypoint,
                     const std::uint8_t* descriptor, const DescriptorKind& kind, ByteWriter& writer);

/// Returns whether a matrix can be a covariance in Point.bin: symmetric, without NaN, variances not negative.
/// They may be infinite, of a point that nothing determines.
[[nodiscard]] bool is_covariance(const Eigen::Matrix3d& matrix);

/// Reads Point.bin of the map in `folder`, as announced by `info`; the rows lie in their range. Throws
/// InputError if the file is missing, damaged, of another version, not the one announced, or holds impossible
/// values.
[[nodiscard]] std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder,
                                                          const MapInfo& info);
/// Reads Descriptor.bin of the map in `folder`, as announced by `info`; the keyframes lie in their range.
/// Throws InputError if the file is missing, damaged, of another version, not the one announced, or holds
/// impossible values.
[[nodiscard]] StoredObservations read_descriptor_file(const std::filesystem::path& folder,
                                                      const MapInfo& info);

}  // namespace cairn
