// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/frame_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "cairn/core/error.h"
#include "cairn/map_files/binary_file.h"

namespace cairn {
namespace {

constexpr BinaryKind kKind{"CAIRNFRM", kMapVersion};
constexpr std::uint64_t kRecordBytes = 36;  // of one feature, without its descriptor

double single(double value) {
  return static_cast<double>(static_cast<float>(value));
}

bool is_possible(const Observation& seen) {
  const auto is_sigma = [](double sigma) { return std::isfinite(sigma) && sigma > 0; };
  return std::isfinite(seen.u) && std::isfinite(seen.v) && is_sigma(seen.sigma_px) &&
         is_sigma(seen.sigma_d_px) && (!seen.has_disparity() || is_sigma(seen.d));
}

void put_feature(const Observation& seen, const Keypoint& keypoint, BinaryWriter& writer) {
  require(is_possible(seen), "an observation is finite and its sigmas are above 0");
  for (const double value : {seen.u, seen.v, seen.d, seen.sigma_px, seen.sigma_d_px})
    writer.put(static_cast<float>(value));
  writer.put(keypoint.size);
  writer.put(keypoint.angle_deg);
}

Observation get_observation(BinaryReader& reader) {
  const auto next = [&] { return static_cast<double>(reader.get<float>()); };
  Observation seen;
  for (double* value : {&seen.u, &seen.v, &seen.d, &seen.sigma_px, &seen.sigma_d_px}) *value = next();
  return seen;
}

Keypoint get_keypoint(const Observation& seen, BinaryReader& reader) {
  Keypoint keypoint;
  keypoint.u = static_cast<float>(seen.u);
  keypoint.v = static_cast<float>(seen.v);
  keypoint.sigma_px = static_cast<float>(seen.sigma_px);
  keypoint.size = reader.get<float>();
  keypoint.angle_deg = reader.get<float>();
  return keypoint;
}

/// Returns the number of features. Fails unless the header is as announced.
std::uint32_t get_header(const MapInfo& info, KeyframeId number, BinaryReader& reader) {
  const KeyframeEntry& entry = info.keyframes[number.index()];
  reader.expect_checksum(entry.checksum);
  const auto found_number = reader.get<std::int32_t>(), frame = reader.get<std::int32_t>();
  if (found_number != number.value || frame != entry.frame.value)
    reader.fail(fmt::format("keyframe {} of frame {}", number.value, entry.frame.value),
                fmt::format("keyframe {} of frame {}", found_number, frame));
  const auto count = reader.get<std::uint32_t>();
  get_descriptor_kind(info.descriptor, reader);
  reader.expect_bytes(count, kRecordBytes + info.descriptor.bytes);
  return count;
}

void get_feature(std::size_t i, const MapInfo& info, BinaryReader& reader, FrameFile& file) {
  if (const auto index = reader.get<std::uint32_t>(); index != i)
    reader.fail(fmt::format("feature {}", i), fmt::format("{}", index));
  const LandmarkId landmark{reader.get<std::int32_t>()};
  const Observation seen = get_observation(reader);
  const Keypoint keypoint = get_keypoint(seen, reader);
  if (!is_possible(seen) || !std::isfinite(keypoint.size) || !std::isfinite(keypoint.angle_deg))
    reader.fail(fmt::format("finite values and sigmas above 0 for feature {}", i), "others");
  if (landmark.value < -1 || landmark.value >= static_cast<std::int64_t>(info.landmarks))
    reader.fail(fmt::format("a landmark below {} or -1 for feature {}", info.landmarks, i),
                fmt::format("{}", landmark.value));
  file.landmarks.push_back(landmark);
  file.observed.observations.push_back(seen);
  file.observed.points_in_camera.push_back(point_in_camera(info.rig, seen));
  file.observed.features.keypoints.push_back(keypoint);
  std::memcpy(file.observed.features.descriptors.row(i), reader.get_bytes(info.descriptor.bytes),
              info.descriptor.bytes);
}

}  // namespace

Observation as_stored(const Observation& seen) {
  return {single(seen.u), single(seen.v), single(seen.d), single(seen.sigma_px), single(seen.sigma_d_px)};
}

std::string format_frame_file(KeyframeId number, const ObservedFrame& observed,
                              std::span<const LandmarkId> landmarks, const DescriptorKind& kind) {
  const auto& [keypoints, descriptors] = observed.features;
  const std::size_t count = observed.observations.size();
  require(keypoints.size() == count && descriptors.count() == count && landmarks.size() == count,
          "each observation has a keypoint and a descriptor");
  require(count == 0 || (descriptors.norm() == kind.norm && descriptors.bytes() == kind.bytes),
          "all descriptors of a map are of one kind");
  BinaryWriter writer(kKind);
  writer.put(number.value);
  writer.put(observed.frame.value);
  writer.put(static_cast<std::uint32_t>(count));
  writer.put(kind.bytes);
  writer.put(static_cast<std::uint32_t>(kind.norm));
  for (std::size_t i = 0; i < count; ++i) {
    writer.put(static_cast<std::uint32_t>(i));
    writer.put(landmarks[i].value);
    put_feature(observed.observations[i], keypoints[i], writer);
    writer.put_bytes(descriptors.row(i), kind.bytes);
  }
  return std::move(writer).finish();
}

FrameFile read_frame_file(const std::filesystem::path& folder, const MapInfo& info, KeyframeId number) {
  const KeyframeEntry& entry = info.keyframes[number.index()];
  BinaryReader reader(folder / frame_file_name(number, info.descriptor.name), kKind);
  const std::uint32_t count = get_header(info, number, reader);
  FrameFile file;
  file.number = number;
  file.observed.frame = entry.frame;
  file.observed.stamp_ns = entry.stamp_ns;
  file.observed.features.descriptors = Descriptors(info.descriptor.norm, info.descriptor.bytes, count);
  for (std::size_t i = 0; i < count; ++i) get_feature(i, info, reader, file);
  return file;
}

}  // namespace cairn
