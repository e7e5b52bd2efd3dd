// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/landmark_stream.h"

#include <fmt/format.h>

namespace cairn {
namespace {

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
  if (count == 0 || count > info.observations - first)
    reader.fail(fmt::format("1 to {} sightings of landmark {}", info.observations - first, number),
                fmt::format("{}", count));
  landmark.first_row = first;
  landmark.observations = count;
  for (double& coordinate : landmark.point_in_world) coordinate = reader.get<double>();
  for (double& entry : landmark.covariance.reshaped()) entry = reader.get<double>();
  if (!landmark.point_in_world.allFinite() || !is_covariance(landmark.covariance))
    reader.fail(fmt::format("a finite point and a covariance for landmark {}", number), "others");
  return landmark;
}

}  // namespace

LandmarkStream::LandmarkStream(const std::filesystem::path& folder, const MapInfo& info)
    : info_(info), reader_(open_announced(folder, info, kPointFile, kPointKind)) {
  expect_count(reader_, info.landmarks, reader_.get<std::uint32_t>(), "landmarks");
  expect_count(reader_, info.observations, reader_.get<std::uint64_t>(), "sightings");
  reader_.expect_bytes(info.landmarks, kLandmarkBytes);
}

std::optional<StoredLandmark> LandmarkStream::next() {
  if (number_ == info_.landmarks) {
    expect_count(reader_, info_.observations, first_row_, "sightings of all landmarks");
    return {};
  }
  const StoredLandmark landmark = get_landmark(number_, first_row_, info_, reader_);
  first_row_ += landmark.observations;
  ++number_;
  return landmark;
}

ObservationStream::ObservationStream(const std::filesystem::path& folder, const MapInfo& info)
    : info_(info), reader_(open_announced(folder, info, kDescriptorFile, kDescriptorKind)) {
  get_descriptor_kind(info.descriptor, reader_);
  const std::size_t stride = observation_bytes(info.descriptor);
  expect_count(reader_, stride, reader_.get<std::uint32_t>(), "bytes a record");
  expect_count(reader_, info.observations, reader_.get<std::uint64_t>(), "sightings");
  reader_.expect_bytes(info.observations, stride);
}

std::optional<ObservationStream::Row> ObservationStream::next() {
  if (row_ == info_.observations) return {};
  const KeyframeId keyframe{reader_.get<std::int32_t>()};
  const std::int32_t feature = reader_.get<std::int32_t>();
  if (!keyframe.valid() || keyframe.index() >= info_.keyframes.size())
    reader_.fail(fmt::format("a keyframe below {} in row {}", info_.keyframes.size(), row_),
                 fmt::format("{}", keyframe.value));
  // Size and sigma, which frames/ has, too, come before the descriptor.
  const char* rest =
      reader_.get_bytes(observation_bytes(info_.descriptor) - sizeof keyframe - sizeof feature);
  ++row_;
  return Row{{keyframe, feature}, rest + 2 * sizeof(float)};
}

}  // namespace cairn
