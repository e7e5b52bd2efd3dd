// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/landmark_files.h"

#include <cstring>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/map/indicators.h"
#include "cairn/map_files/landmark_stream.h"

namespace cairn {
namespace {

/// Returns the size of a descriptor that is filled up so that all records begin at a multiple of 8.
std::size_t padded(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

}  // namespace

bool is_covariance(const Eigen::Matrix3d& matrix) {
  return !matrix.hasNaN() && matrix == matrix.transpose() && matrix.diagonal().minCoeff() >= 0;
}

double largest_std(const StoredLandmark& landmark) {
  return landmark.covariance.isZero(0) ? std::numeric_limits<double>::quiet_NaN()
                                       : largest_std(landmark.covariance);
}

std::size_t observation_bytes(const DescriptorKind& kind) {
  return kObservationHead + padded(kind.bytes);
}

BinaryWriter begin_point_file(std::uint32_t landmarks, std::uint64_t observations) {
  BinaryWriter writer(kPointKind);
  writer.put(landmarks);
  writer.put(observations);
  return writer;
}

BinaryWriter begin_descriptor_file(const DescriptorKind& kind, std::uint64_t observations) {
  BinaryWriter writer(kDescriptorKind);
  writer.put(kind.bytes);
  writer.put(static_cast<std::uint32_t>(kind.norm));
  writer.put(static_cast<std::uint32_t>(observation_bytes(kind)));
  writer.put(observations);
  return writer;
}

void put_landmark(std::uint32_t number, const StoredLandmark& landmark, ByteWriter& writer) {
  require(landmark.point_in_world.allFinite() && is_covariance(landmark.covariance),
          "a landmark's point is finite, its covariance symmetric");
  writer.put(number);
  writer.put(landmark.observations);
  writer.put(landmark.first_row);
  for (const double coordinate : landmark.point_in_world) writer.put(coordinate);
  for (const double entry : landmark.covariance.reshaped()) writer.put(entry);
}

BinaryWriter begin_noise_file(std::uint32_t landmarks) {
  BinaryWriter writer(kNoiseKind);
  writer.put(landmarks);
  return writer;
}

void put_noise(const Eigen::Matrix3d& covariance, ByteWriter& writer) {
  require(is_covariance(covariance), "the covariance of a landmark by noise is symmetric");
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = row; column < 3; ++column) writer.put(covariance(row, column));
}

void put_observation(const ObservationRef& observation, const Keypoint& keypoint,
                     const std::uint8_t* descriptor, const DescriptorKind& kind, ByteWriter& writer) {
  writer.put(observation.keyframe.value);
  writer.put(observation.feature);
  writer.put(keypoint.size);
  writer.put(keypoint.sigma_px);
  writer.put_bytes(descriptor, kind.bytes);
  constexpr std::uint64_t kZeros = 0;
  writer.put_bytes(&kZeros, padded(kind.bytes) - kind.bytes);
}

std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder, const MapInfo& info) {
  LandmarkStream stream(folder, info);
  std::vector<StoredLandmark> landmarks;
  while (const auto landmark = stream.next()) landmarks.push_back(*landmark);
  return landmarks;
}

StoredObservations read_descriptor_file(const std::filesystem::path& folder, const MapInfo& info) {
  ObservationStream stream(folder, info);
  StoredObservations stored{{}, Descriptors(info.descriptor.norm, info.descriptor.bytes, info.observations)};
  while (const auto row = stream.next()) {
    std::memcpy(stored.descriptors.row(stored.observations.size()), row->descriptor, info.descriptor.bytes);
    stored.observations.push_back(row->observation);
  }
  return stored;
}

}  // namespace cairn
