// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "cairn/core/error.h"
#include "cairn/map_files/binary_file.h"
#include "cairn/map_files/frame_file.h"
#include "cairn/map_files/landmark_files.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_info.h"
#include "cairn/map_files/map_text_files.h"
#include "cairn/map_files/place_layout.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Holds the contents of all files of a map, each valid in itself.
struct MapFiles {
  fs::path folder;
  MapInfo info;
  std::vector<WorldFromCamera> poses;
  std::vector<FrameFile> frames;
  std::vector<StoredLandmark> landmarks;
  StoredObservations observations;
};

[[noreturn]] void fail(const fs::path& path, std::string expected, std::string found) {
  throw InputError({path.string(), 0, std::move(expected), std::move(found), std::string(kMapRemedy)});
}

std::vector<FrameFile> read_frames(const fs::path& folder, const MapInfo& info) {
  std::vector<FrameFile> frames;
  std::uint64_t features = 0;
  for (std::size_t i = 0; i < info.keyframes.size(); ++i) {
    frames.push_back(read_frame_file(folder, info, {static_cast<std::int32_t>(i)}));
    features += frames.back().landmarks.size();
  }
  if (features != info.features)
    fail(folder / kMapInfoFile, fmt::format("{} features, as the files in frames/ have", features),
         fmt::format("{}", info.features));
  return frames;
}

MapFiles read_files(const fs::path& folder) {
  MapFiles files;
  files.folder = folder;
  files.info = read_map_info(folder / kMapInfoFile);
  files.poses = read_map_poses(folder, files.info);
  check_map_text(folder, files.info, kUvlistFile);
  files.frames = read_frames(folder, files.info);
  files.landmarks = read_point_file(folder, files.info);
  files.observations = read_descriptor_file(folder, files.info);
  check_sealed_file(folder / kPlaceFile, kPlaceKind, files.info.checksum_of(kPlaceFile));
  return files;
}

/// Fails unless the feature of an observation shows this landmark and has the descriptor in Descriptor.bin.
void check_observation(const MapFiles& files, std::size_t landmark, std::size_t row) {
  const ObservationRef& observation = files.observations.observations[row];
  const FrameFile& frame = files.frames[observation.keyframe.index()];
  const auto feature = static_cast<std::size_t>(observation.feature);
  const bool shows = observation.feature >= 0 && feature < frame.landmarks.size() &&
                     frame.landmarks[feature].value == static_cast<std::int64_t>(landmark);
  if (!shows)
    fail(files.folder / kPointFile,
         fmt::format("landmark {} where keyframe {} shows it", landmark, observation.keyframe.value),
         fmt::format("it at feature {}", observation.feature));
  const Descriptors& described = frame.observed.features.descriptors;
  if (std::memcmp(described.row(feature), files.observations.descriptors.row(row), described.bytes()) != 0)
    fail(files.folder / kDescriptorFile, fmt::format("in row {} the descriptor of frames/", row), "another");
}

/// Fails unless Point.bin, Descriptor.bin and frames/ agree.
void check_observations(const MapFiles& files) {
  for (std::size_t i = 0; i < files.landmarks.size(); ++i) {
    KeyframeId before;
    const StoredLandmark& landmark = files.landmarks[i];
    for (std::size_t row = landmark.first_row; row < landmark.first_row + landmark.observations; ++row) {
      check_observation(files, i, row);
      const KeyframeId keyframe = files.observations.observations[row].keyframe;
      if (keyframe <= before)
        fail(files.folder / kPointFile, fmt::format("increasing keyframes of landmark {}", i),
             fmt::format("{} after {}", keyframe.value, before.value));
      before = keyframe;
    }
  }
  std::uint64_t shown = 0;
  for (const FrameFile& frame : files.frames)
    shown += static_cast<std::uint64_t>(std::count_if(frame.landmarks.begin(), frame.landmarks.end(),
                                                      [](LandmarkId id) { return id.valid(); }));
  if (shown != files.info.observations)
    fail(files.folder / kPointFile, fmt::format("{} sightings, as frames/ has", shown),
         fmt::format("{}", files.info.observations));
}

/// Returns for each keyframe the earlier one of its component that shows most of the landmarks that it shows,
/// the latest of several, or the one before it in its component; not valid for a component's first.
std::vector<KeyframeId> choose_parents(const MapFiles& files) {
  const auto component_of = [&](std::size_t keyframe) { return files.info.keyframes[keyframe].component; };
  std::vector<KeyframeId> parents(files.frames.size());
  std::vector<std::vector<std::size_t>> shown_by(files.landmarks.size());
  for (std::size_t i = 0; i < files.frames.size(); ++i) {
    std::vector<int> shared(i, 0);
    for (const LandmarkId id : files.frames[i].landmarks) {
      if (!id.valid()) continue;
      auto& earlier = shown_by[id.index()];
      for (const std::size_t keyframe : earlier) ++shared[keyframe];
      earlier.push_back(i);
    }
    int most = 0;
    for (std::size_t k = 0; k < i; ++k) {
      if (component_of(k) != component_of(i) || shared[k] < most) continue;
      most = shared[k];
      parents[i] = {static_cast<std::int32_t>(k)};
    }
  }
  return parents;
}

/// Builds the map of files that were checked, and moves their contents into it.
Map build_map(MapFiles&& files) {
  Map map(static_cast<const MapHeader&>(files.info));
  const std::vector<KeyframeId> parents = choose_parents(files);
  for (std::size_t i = 0; i < files.frames.size(); ++i)
    map.add_keyframe(std::move(files.frames[i].observed), files.poses[i], parents[i],
                     files.info.keyframes[i].component);
  for (const StoredLandmark& landmark : files.landmarks) {
    LandmarkId id;
    for (std::size_t row = landmark.first_row; row < landmark.first_row + landmark.observations; ++row) {
      const ObservationRef& observation = files.observations.observations[row];
      if (id.valid())
        map.add_observation(id, observation);
      else
        id = map.add_landmark(landmark.point_in_world, observation);
    }
  }
  return map;
}

}  // namespace

fs::path require_map_folder(const fs::path& folder) {
  if (const auto found = find_map_folder(folder)) return *found;
  std::error_code error;
  throw InputError({folder.string(), 0, "the folder of a map, or of a run with one in its map/",
                    fs::exists(folder, error) ? "none of its files" : "nothing of that name",
                    "Check the path; cairn map and cairn slam make maps."});
}

std::optional<fs::path> find_map_folder(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& candidate : {folder, folder / "map"})
    for (const char* name : {kMapInfoFile, kPointFile, kDescriptorFile})
      if (fs::is_regular_file(candidate / name, error)) return candidate;
  return {};
}

Map read_map(const fs::path& folder) {
  MapFiles files = read_files(require_map_folder(folder));
  check_observations(files);
  return build_map(std::move(files));
}

std::vector<Eigen::Matrix3d> read_covariances(const fs::path& folder) {
  const fs::path place = require_map_folder(folder);
  std::vector<Eigen::Matrix3d> covariances;
  for (const StoredLandmark& landmark : read_point_file(place, read_map_info(place / kMapInfoFile)))
    covariances.push_back(landmark.covariance);
  return covariances;
}

}  // namespace cairn
