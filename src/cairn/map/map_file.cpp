// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {
namespace {

constexpr std::string_view kMagic = "CAIRNFRM";
constexpr std::uint32_t kVersion = 1;

template <class Value>
void append(std::string& bytes, Value value) {
  static_assert(std::endian::native == std::endian::little, "the files are little-endian");
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes.append(raw, sizeof(Value));
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

const Descriptors& descriptors_of(const Map& map) {
  return map[map.keyframe_ids().front()].observed.features.descriptors;
}

std::string format_map_json(const Map& map) {
  std::size_t features = 0;
  const auto keyframes = map.keyframe_ids();
  for (const KeyframeId id : keyframes) features += map[id].observed.observations.size();
  const Rig& rig = map.rig();
  return fmt::format(
      "{{\n  \"format\": \"cairn keyframe map\",\n  \"version\": {},\n  \"frame\": \"camera of the first "
      "keyframe\",\n"
      "  \"rig\": {{\"fx\": {}, \"fy\": {}, \"cx\": {}, \"cy\": {}, \"baseline\": {}}},\n"
      "  \"descriptor\": {{\"name\": \"{}\", \"norm\": \"{}\", \"bytes\": {}}},\n"
      "  \"keyframes\": {},\n  \"features\": {},\n  \"landmarks\": {}\n}}\n",
      kVersion, rig.fx, rig.fy, rig.cx, rig.cy, rig.baseline, map.descriptor(),
      descriptors_of(map).norm() == Norm::hamming ? "hamming" : "l2", descriptors_of(map).bytes(),
      keyframes.size(), features, map.landmark_ids().size());
}

}  // namespace

std::string format_frame_file(const Keyframe& keyframe) {
  const ObservedFrame& frame = keyframe.observed;
  const Descriptors& descriptors = frame.features.descriptors;
  require(descriptors.count() == frame.observations.size(), "each observation has a descriptor");
  std::string bytes(kMagic);
  append(bytes, kVersion);
  append(bytes, frame.frame.value);
  append(bytes, static_cast<std::uint32_t>(descriptors.count()));
  append(bytes, static_cast<std::uint32_t>(descriptors.bytes()));
  append(bytes, static_cast<std::uint32_t>(descriptors.norm() == Norm::hamming ? 0 : 1));
  for (std::size_t i = 0; i < descriptors.count(); ++i) {
    const Observation& seen = frame.observations[i];
    append(bytes, static_cast<std::uint32_t>(i));
    append(bytes, keyframe.landmarks[i].value);
    append(bytes, static_cast<float>(seen.u));
    append(bytes, static_cast<float>(seen.v));
    append(bytes, static_cast<float>(seen.d));
    bytes.append(reinterpret_cast<const char*>(descriptors.row(i)), descriptors.bytes());
  }
  append(bytes, crc32(bytes));
  return bytes;
}

void write_map(const std::filesystem::path& folder, const Map& map) {
  require(!map.keyframe_ids().empty(), "a map to write has keyframes");
  std::error_code error;
  std::filesystem::create_directories(folder / "frames", error);
  if (error)
    throw InputError(
        {folder.string(), 0, "to make the folder", error.message(), "Check the path and the disk."});
  Trajectory poses;
  for (const KeyframeId id : map.keyframe_ids()) {
    const Keyframe& keyframe = map[id];
    poses.push_back({keyframe.observed.stamp_ns, WorldFromCamera(keyframe.world_from_camera)});
    const std::string name = fmt::format("{:06}.{}", keyframe.observed.frame.value, lower(map.descriptor()));
    write_file(folder / "frames" / name, format_frame_file(keyframe));
  }
  write_file(folder / "poses.txt", format_tum_trajectory(poses));
  write_file(folder / "map.json", format_map_json(map));
}

}  // namespace cairn
