// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/landmark_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cairn/core/error.h"
#include "cairn/map/binary_file.h"

namespace cairn {
namespace {

constexpr BinaryKind kPointKind{"CAIRNPNT", kMapVersion};
constexpr BinaryKind kDescriptorKind{"CAIRNDSC", kMapVersion};
constexpr std::uint64_t kLandmarkBytes = 112;  // number, count, first; 3 coordinates, 9 of the covariance
constexpr std::uint64_t kSightingBytes = 8;    // keyframe, feature; the descriptor follows

/// Of a descriptor that is filled up, so that all records begin at a multiple of 8.
std::uint64_t padded(std::uint64_t bytes) {
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

/// Infinite variances are possible: of a point that nothing determines.
bool is_covariance(const Eigen::Matrix3d& matrix) {
  return !matrix.hasNaN() && matrix == matrix.transpose() && matrix.diagonal().minCoeff() >= 0;
}

/// The landmark without its sightings, which are `count` from `first` on.
void put_landmark(const StoredLandmark& landmark, std::uint32_t number, std::uint64_t first,
                  BinaryWriter& writer) {
  writer.put(number);
  writer.put(static_cast<std::uint32_t>(landmark.descriptors.size()));
  writer.put(first);
  for (const double coordinate : landmark.point_in_world) writer.put(coordinate);
  for (const double entry : landmark.covariance.reshaped()) writer.put(entry);
}

/// A landmark with room for its sightings; they are in order, behind all landmarks.
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
  landmark.descriptors.resize(count);
  for (double& coordinate : landmark.point_in_world) coordinate = reader.get<double>();
  for (double& entry : landmark.covariance.reshaped()) entry = reader.get<double>();
  if (!landmark.point_in_world.allFinite() || !is_covariance(landmark.covariance))
    reader.fail(fmt::format("a finite point and a covariance for landmark {}", number), "others");
  return landmark;
}

}  // namespace

std::string format_point_file(const std::vector<StoredLandmark>& landmarks) {
  std::uint64_t sightings = 0;
  for (const StoredLandmark& landmark : landmarks) sightings += landmark.descriptors.size();
  BinaryWriter writer(kPointKind);
  writer.put(static_cast<std::uint32_t>(landmarks.size()));
  writer.put(sightings);
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    require(landmarks[i].point_in_world.allFinite() && is_covariance(landmarks[i].covariance),
            "a landmark's point is finite, its covariance symmetric");
    put_landmark(landmarks[i], static_cast<std::uint32_t>(i), first, writer);
    first += landmarks[i].descriptors.size();
  }
  for (const StoredLandmark& landmark : landmarks)
    for (const std::uint32_t descriptor : landmark.descriptors) writer.put(descriptor);
  return std::move(writer).finish();
}

std::string format_descriptor_file(const StoredSightings& stored, const DescriptorKind& kind) {
  require(stored.descriptors.count() == stored.sightings.size(), "each sighting has a descriptor");
  BinaryWriter writer(kDescriptorKind);
  writer.put(kind.bytes);
  writer.put(static_cast<std::uint32_t>(kind.norm));
  writer.put(static_cast<std::uint32_t>(kSightingBytes + padded(kind.bytes)));
  writer.put(static_cast<std::uint64_t>(stored.sightings.size()));
  for (std::size_t i = 0; i < stored.sightings.size(); ++i) {
    writer.put(stored.sightings[i].keyframe.value);
    writer.put(stored.sightings[i].feature);
    writer.put_bytes(stored.descriptors.row(i), stored.descriptors.stride());
  }
  return std::move(writer).finish();
}

std::vector<StoredLandmark> read_point_file(const std::filesystem::path& folder, const MapInfo& info) {
  BinaryReader reader = open_announced(folder, info, kPointFile, kPointKind);
  expect_count(reader, info.landmarks, reader.get<std::uint32_t>(), "landmarks");
  expect_count(reader, info.sightings, reader.get<std::uint64_t>(), "sightings");
  reader.expect_bytes(info.landmarks, kLandmarkBytes, info.sightings, sizeof(std::uint32_t));
  std::vector<StoredLandmark> landmarks;
  std::uint64_t first = 0;
  for (std::uint32_t i = 0; i < info.landmarks; ++i) {
    landmarks.push_back(get_landmark(i, first, info, reader));
    first += landmarks.back().descriptors.size();
  }
  expect_count(reader, info.sightings, first, "sightings of all landmarks");
  for (StoredLandmark& landmark : landmarks) {
    for (std::uint32_t& descriptor : landmark.descriptors) {
      descriptor = reader.get<std::uint32_t>();
      if (descriptor >= info.sightings)
        reader.fail(fmt::format("a row below {} of {}", info.sightings, kDescriptorFile),
                    fmt::format("{}", descriptor));
    }
  }
  return landmarks;
}

StoredSightings read_descriptor_file(const std::filesystem::path& folder, const MapInfo& info) {
  BinaryReader reader = open_announced(folder, info, kDescriptorFile, kDescriptorKind);
  get_descriptor_kind(info.descriptor, reader);
  const std::uint32_t bytes = info.descriptor.bytes;
  const std::uint64_t stride = kSightingBytes + padded(bytes);
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
    std::memcpy(stored.descriptors.row(i), reader.get_bytes(padded(bytes)), bytes);
  }
  return stored;
}

}  // namespace cairn
