// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/landmark_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cairn/core/error.h"
#include "cairn/map/binary_file.h"

namespace cairn {
namespace {

/// Of a descriptor that is filled up, so that all records begin at a multiple of 8.
std::size_t padded(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

BinaryReader open_announced(const std::filesystem::path& folder, const MapInfo& info, const char* name,
                            const BinaryKind& kind) {
  BinaryReader reader(folder / name, kind);
  reader.expect_checksum(info.checksum_of(name));
  return reader;
}

void expect_count(const BinaryReader& reader, std::uint64_t expected, std::uint64_t found,
                  std::string_view what) {
  if (found != expected)
    reader.fail(fmt::format("{} {}, as map.json says", expected, what), fmt::format("{}", found));
}

StoredLandmark get_landmark(std::uint32_t number, std::uint64_t first, const MapInfo& info,
                            BinaryReader& reader) {
  StoredLandmark landmark;
  const auto found_number = reader.get<std::uint32_t>(), count = reader.get<std::uint32_t>();
  const auto found_first = reader.get<std::uint64_t>();
  if (found_number != number || found_first != first)
    reader.fail(fmt::format("landmark {} with sightings from {}", number, first),
                fmt::format("landmark {} with sightings from {}", found_number, found_first));
  if (count == 0 || count > info.sightings - first)
    reader.fail(fmt::format("1 to {} sightings of landmark {}", info.sightings - first, number),
                fmt::format("{}", count));
  landmark.first_row = first;
  landmark.sightings = count;
  for (double& coordinate : landmark.point_in_world) coordinate = reader.get<double>();
  for (double& entry : landmark.covariance.reshaped()) entry = reader.get<double>();
  if (!landmark.point_in_world.allFinite() || !is_covariance(landmark.covariance))
    reader.fail(fmt::format("a finite point and a covariance for landmark {}", number), "others");
  return landmark;
}

}  // namespace

bool is_covariance(const Eigen::Matrix3d& matrix) {
  return !matrix.hasNaN() && matrix == matrix.transpose() && matrix.diagonal().minCoeff() >= 0;
}

std::size_t sighting_bytes(const DescriptorKind& kind) {
  return kSightingHead + padded(kind.bytes);
}

BinaryWriter begin_point_file(std::uint32_t landmarks, std::uint64_t sightings) {
  BinaryWriter writer(kPointKind);
  writer.put(landmarks);
  writer.put(sightings);
  return writer;
}

BinaryWriter begin_descriptor_file(const DescriptorKind& kind, std::uint64_t sightings) {
  BinaryWriter writer(kDescriptorKind);
  writer.put(kind.bytes);
  writer.put(static_cast<std::uint32_t>(kind.norm));
  writer.put(static_cast<std::uint32_t>(sighting_bytes(kind)));
  writer.put(sightings);
  return writer;
}

void put_landmark(std::uint32_t number, const StoredLandmark& landmark, ByteWriter& writer) {
  require(landmark.point_in_world.allFinite() && is_covariance(landmark.covariance),
          "a landmark's point is finite, its covariance symmetric");
  writer.put(number);
  writer.put(landmark.sightings);
  writer.put(landmark.first_row);
  for (const double coordinate : landmark.point_in_world) writer.put(coordinate);
  for (const double entry : landmark.covariance.reshaped()) writer.put(entry);
}

void put_sighting(const Sighting& sighting, const Keypoint& keypoint, const std::uint8_t* descriptor,
                  const DescriptorKind& kind, ByteWriter& writer) {
  writer.put(sighting.keyframe.value);
  writer.put(sighting.feature);
  writer.put(keypoint.size);
  writer.put(keypoint.sigma_px);
  writer.put_bytes(descriptor, kind.bytes);
  constexpr std::uint64_t kZeros = 0;
  writer.put_bytes(&kZeros, padded(kind.bytes) - kind.bytes);
}

std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder, const MapInfo& info) {
  BinaryReader reader = open_announced(folder, info, kPointFile, kPointKind);
  expect_count(reader, info.landmarks, reader.get<std::uint32_t>(), "landmarks");
  expect_count(reader, info.sightings, reader.get<std::uint64_t>(), "sightings");
  reader.expect_bytes(info.landmarks, kLandmarkBytes);
  std::vector<StoredLandmark> landmarks;
  std::uint64_t first = 0;
  for (std::uint32_t i = 0; i < info.landmarks; ++i) {
    landmarks.push_back(get_landmark(i, first, info, reader));
    first += landmarks.back().sightings;
  }
  expect_count(reader, info.sightings, first, "sightings of all landmarks");
  return landmarks;
}

StoredSightings read_descriptor_file(const std::filesystem::path& folder, const MapInfo& info) {
  BinaryReader reader = open_announced(folder, info, kDescriptorFile, kDescriptorKind);
  get_descriptor_kind(info.descriptor, reader);
  const std::uint32_t bytes = info.descriptor.bytes;
  const std::size_t stride = sighting_bytes(info.descriptor);
  expect_count(reader, stride, reader.get<std::uint32_t>(), "bytes a record");
  expect_count(reader, info.sightings, reader.get<std::uint64_t>(), "sightings");
  reader.expect_bytes(info.sightings, stride);
  StoredSightings stored{{}, Descriptors(info.descriptor.norm, bytes, info.sightings)};
  for (std::size_t i = 0; i < info.sightings; ++i) {
    const KeyframeId keyframe{reader.get<std::int32_t>()};
    stored.sightings.push_back({keyframe, reader.get<std::int32_t>()});
    if (!keyframe.valid() || static_cast<std::size_t>(keyframe.value) >= info.keyframes.size())
      reader.fail(fmt::format("a keyframe below {} in row {}", info.keyframes.size(), i),
                  fmt::format("{}", keyframe.value));
    (void)reader.get<float>();  // size and sigma, which frames/ has, too
    (void)reader.get<float>();
    std::memcpy(stored.descriptors.row(i), reader.get_bytes(padded(bytes)), bytes);
  }
  return stored;
}

}  // namespace cairn
