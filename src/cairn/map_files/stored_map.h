// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/map_files/landmark_files.h"
#include "cairn/map_files/map_info.h"
#include "cairn/map_files/place_file.h"

namespace cairn {

/// A keyframe of a map, with those of its features that show a landmark.
struct StoredKeyframe {
  WorldFromCamera world_from_camera;
  std::vector<LandmarkId> landmarks;
  std::vector<Keypoint> keypoints;  ///< of each
  Descriptors descriptors;          ///< of each
};

/// A map on disk, opened for reading without reading it: the large files are mapped into memory, and what is
/// asked for is checked when it is first touched. Safe to use from several threads. InputError names a file
/// that is missing, damaged, of another version, or does not fit the others.
class StoredMap {
 public:
  /// The folder of a map, or of a run with one in its map/.
  explicit StoredMap(const std::filesystem::path& folder);
  ~StoredMap();
  StoredMap(const StoredMap&) = delete;
  StoredMap& operator=(const StoredMap&) = delete;

  [[nodiscard]] const MapInfo& info() const { return info_; }
  /// world_from_camera of each keyframe.
  [[nodiscard]] const std::vector<WorldFromCamera>& poses() const { return poses_; }
  /// Whether the keyframe is of the component with the most keyframes, which alone has one world.
  [[nodiscard]] bool in_main_component(KeyframeId id) const;
  [[nodiscard]] const PlaceFile& places() const { return places_; }
  [[nodiscard]] StoredLandmark landmark(LandmarkId id) const;
  /// Read when it is first asked for; those used last are kept in memory.
  [[nodiscard]] std::shared_ptr<const StoredKeyframe> keyframe(KeyframeId id) const;

  /// Returns what was read of the mapped files, landmarks and places, so far.
  [[nodiscard]] std::uint64_t touched_bytes() const;

  /// Checks the bytes of all files, also of those that are never touched. Takes as long as reading them.
  void check() const;

 private:
  class Cache;

  std::filesystem::path folder_;
  MapInfo info_;
  std::vector<WorldFromCamera> poses_;
  MappedFile points_;
  PlaceFile places_;
  std::int32_t main_component_ = 0;
  std::unique_ptr<Cache> cache_;
};

}  // namespace cairn
