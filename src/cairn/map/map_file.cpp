// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/map_file.h"

#include <fmt/format.h>

#include <cstring>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/map/binary_file.h"
#include "cairn/map/frame_file.h"
#include "cairn/map/landmark_files.h"
#include "cairn/map/map_info.h"
#include "cairn/map/uvlist.h"

namespace cairn {
namespace {

/// What is written of a map, in the order in which it is numbered.
struct Selection {
  std::vector<KeyframeId> keyframes;
  std::vector<LandmarkId> landmarks;
  std::vector<KeyframeId> keyframe_numbers;  ///< of each keyframe of the map; not valid where it is erased
  std::vector<LandmarkId> landmark_numbers;
};

template <class AnyId>
std::vector<AnyId> numbers_of(const std::vector<AnyId>& selected, std::size_t count) {
  std::vector<AnyId> numbers(count);
  for (std::size_t i = 0; i < selected.size(); ++i)
    numbers[static_cast<std::size_t>(selected[i].value)] = {static_cast<std::int32_t>(i)};
  return numbers;
}

Selection select(const Map& map) {
  Selection selection{map.keyframe_ids(), map.landmark_ids(), {}, {}};
  selection.keyframe_numbers = numbers_of(selection.keyframes, map.keyframes().size());
  selection.landmark_numbers = numbers_of(selection.landmarks, map.landmarks().size());
  return selection;
}

DescriptorKind descriptor_kind(const Map& map) {
  require(is_known_descriptor(map.descriptor()), "a map's descriptor is one of descriptor_names()");
  DescriptorKind kind{map.descriptor()};
  for (const Keyframe& keyframe : map.keyframes()) {
    const Descriptors& descriptors = keyframe.observed.features.descriptors;
    if (descriptors.count() == 0) continue;
    kind.norm = descriptors.norm();
    kind.bytes = static_cast<std::uint32_t>(descriptors.bytes());
    break;
  }
  return kind;
}

/// Of the selected landmarks: symmetric to the bit, zero where none is given.
std::vector<Eigen::Matrix3d> select_covariances(const Map& map, const Selection& selection,
                                                std::span<const Eigen::Matrix3d> covariances) {
  require(covariances.empty() || covariances.size() == map.landmarks().size(),
          "a covariance for each landmark, or none");
  std::vector<Eigen::Matrix3d> selected(selection.landmarks.size(), Eigen::Matrix3d::Zero());
  if (covariances.empty()) return selected;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    const Eigen::Matrix3d& given = covariances[static_cast<std::size_t>(selection.landmarks[i].value)];
    selected[i] = 0.5 * (given + given.transpose());
  }
  return selected;
}

/// The features that show a landmark, landmark by landmark.
StoredSightings collect_sightings(const Map& map, const Selection& selection, const DescriptorKind& kind) {
  std::vector<Sighting> sightings;
  for (const LandmarkId id : selection.landmarks)
    sightings.insert(sightings.end(), map[id].sightings.begin(), map[id].sightings.end());
  StoredSightings stored{std::move(sightings), {}};
  stored.descriptors = Descriptors(kind.norm, kind.bytes, stored.sightings.size());
  for (std::size_t i = 0; i < stored.sightings.size(); ++i) {
    Sighting& sighting = stored.sightings[i];
    const Descriptors& all = map[sighting.keyframe].observed.features.descriptors;
    std::memcpy(stored.descriptors.row(i), all.row(static_cast<std::size_t>(sighting.feature)), kind.bytes);
    sighting.keyframe = selection.keyframe_numbers[static_cast<std::size_t>(sighting.keyframe.value)];
  }
  return stored;
}

std::vector<StoredLandmark> collect_landmarks(const Map& map, const Selection& selection,
                                              std::span<const Eigen::Matrix3d> covariances) {
  std::vector<StoredLandmark> landmarks;
  std::uint32_t row = 0;
  for (std::size_t i = 0; i < selection.landmarks.size(); ++i) {
    const Landmark& landmark = map[selection.landmarks[i]];
    landmarks.push_back({landmark.point_in_world, covariances[i], {}});
    for (std::size_t k = 0; k < landmark.sightings.size(); ++k) landmarks.back().descriptors.push_back(row++);
  }
  return landmarks;
}

/// TUM format with all digits.
std::string format_poses(const Map& map, const Selection& selection) {
  std::string text = "# t tx ty tz qx qy qz qw  (seconds, metres; world_from_camera)\n";
  for (const KeyframeId id : selection.keyframes) {
    const auto& t = map[id].world_from_camera.translation;
    const Eigen::Quaterniond q = unit_rotation(map[id].world_from_camera.rotation);
    text += fmt::format("{} {} {} {} {} {} {} {}\n", format_stamp(map[id].observed.stamp_ns), t.x(), t.y(),
                        t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

/// Writes the files of a map and notes in map.json what they are.
class MapWriter {
 public:
  MapWriter(const std::filesystem::path& folder, const Map& map)
      : folder_(folder), map_(map), selection_(select(map)) {
    info_.rig = map.rig();
    info_.descriptor = descriptor_kind(map);
  }

  void write(std::span<const Eigen::Matrix3d> given) {
    const auto covariances = select_covariances(map_, selection_, given);
    write_frames();
    write_landmarks(covariances);
    write_text(kPosesFile, format_poses(map_, selection_));
    write_text(kUvlistFile, format_uvlist(map_, selection_.landmarks, covariances));
    write_file(folder_ / kMapInfoFile, format_map_info(info_));  // last: it says that all others are there
  }

 private:
  void write_frames() {
    std::error_code error;
    std::filesystem::create_directories(folder_ / "frames", error);
    if (error) fail_writing(folder_ / "frames", "make the folder", error.value());
    for (std::size_t i = 0; i < selection_.keyframes.size(); ++i) {
      const Keyframe& keyframe = map_[selection_.keyframes[i]];
      const KeyframeId number{static_cast<std::int32_t>(i)};
      const std::string bytes =
          format_frame_file(number, keyframe.observed, renumbered(keyframe.landmarks), info_.descriptor);
      info_.keyframes.push_back(
          {keyframe.observed.frame, keyframe.observed.stamp_ns, keyframe.part, stored_checksum(bytes)});
      info_.features += keyframe.observed.observations.size();
      write_file(folder_ / frame_file_name(number, info_.descriptor.name), bytes);
    }
  }

  [[nodiscard]] std::vector<LandmarkId> renumbered(const std::vector<LandmarkId>& landmarks) const {
    std::vector<LandmarkId> numbers(landmarks.size());
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      if (landmarks[i].valid())
        numbers[i] = selection_.landmark_numbers[static_cast<std::size_t>(landmarks[i].value)];
    }
    return numbers;
  }

  void write_landmarks(std::span<const Eigen::Matrix3d> covariances) {
    const StoredSightings sightings = collect_sightings(map_, selection_, info_.descriptor);
    info_.landmarks = static_cast<std::uint32_t>(selection_.landmarks.size());
    info_.sightings = sightings.sightings.size();
    write_binary(kPointFile, format_point_file(collect_landmarks(map_, selection_, covariances)));
    write_binary(kDescriptorFile, format_descriptor_file(sightings, info_.descriptor));
  }

  void write_binary(const char* name, const std::string& bytes) {
    info_.checksums[name] = stored_checksum(bytes);
    write_file(folder_ / name, bytes);
  }

  void write_text(const char* name, const std::string& text) {
    info_.checksums[name] = crc32(text);
    write_file(folder_ / name, text);
  }

  std::filesystem::path folder_;
  const Map& map_;
  Selection selection_;
  MapInfo info_;
};

}  // namespace

void write_map(const std::filesystem::path& folder, const Map& map,
               std::span<const Eigen::Matrix3d> covariances) {
  require(!map.keyframe_ids().empty(), "a map to write has keyframes");
  OutputFolder output(folder, "map");
  MapWriter(output.work(), map).write(covariances);
  output.commit();
}

}  // namespace cairn
