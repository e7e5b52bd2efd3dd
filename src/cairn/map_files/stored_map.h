// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/map/held_out_frame.h"
#include "cairn/map_files/landmark_files.h"
#include "cairn/map_files/map_info.h"
#include "cairn/map_files/place_file.h"

namespace cairn {

/// Holds a keyframe of a map, with those of its features that show a landmark.
struct StoredKeyframe {
  WorldFromCamera world_from_camera;
  std::vector<LandmarkId> landmarks;  ///< landmark that each feature shows
  std::vector<Keypoint> keypoints;    ///< one per feature
  Descriptors descriptors;            ///< one per feature
};

/// Opens a map on disk without reading all of it: the large files are mapped into memory, and what is asked
/// for is checked when it is first touched. Safe to use from several threads. Throws InputError that names a
/// file that is missing, damaged, of another version, or does not fit the others.
class StoredMap {
 public:
  /// Opens the map in `folder`, or that of a run in its map/.
  explicit StoredMap(const std::filesystem::path& folder);
  ~StoredMap();
  StoredMap(const StoredMap&) = delete;
  StoredMap& operator=(const StoredMap&) = delete;

  [[nodiscard]] const MapInfo& info() const { return info_; }
  /// Returns world_from_camera of each keyframe.
  [[nodiscard]] const std::vector<WorldFromCamera>& poses() const { return poses_; }
  /// Returns whether a keyframe is in the main component, the one with the most keyframes. Only poses of one
  /// component have a common world.
  [[nodiscard]] bool in_main_component(KeyframeId id) const;
  /// Returns the frames that were located without their observations; none of a map that has no such file.
  [[nodiscard]] const std::vector<HeldOutFrame>& held_out() const { return held_out_; }
  [[nodiscard]] const PlaceFile& places() const { return places_; }
  /// Returns a landmark. Throws PreconditionError if it is not in the map.
  [[nodiscard]] StoredLandmark landmark(LandmarkId id) const;
  /// Returns the part of a landmark's covariance that is its own: what it does not have in common with its
  /// neighbours. Square metres; all of it if the map does not tell them apart. Throws PreconditionError if
  /// the landmark is not in the map.
  [[nodiscard]] Eigen::Matrix3d noise_covariance(LandmarkId id) const;
  /// Returns a keyframe, which is read when it is first asked for; those used last are kept in memory. Throws
  /// PreconditionError if it is not in the map.
  [[nodiscard]] std::shared_ptr<const StoredKeyframe> keyframe(KeyframeId id) const;

  /// Returns how much of the mapped files, landmarks and places, was read so far, bytes.
  [[nodiscard]] std::uint64_t touched_bytes() const;

  /// Checks the bytes of all files, also of those that are never touched. Takes as long as reading them.
  /// Throws InputError for a damaged file.
  void check() const;

 private:
  class Cache;

  std::filesystem::path folder_;
  MapInfo info_;
  std::vector<WorldFromCamera> poses_;
  std::vector<HeldOutFrame> held_out_;
  MappedFile points_;
  std::optional<MappedFile> noise_;
  PlaceFile places_;
  std::int32_t main_component_ = 0;
  std::unique_ptr<Cache> cache_;
};

}  // namespace cairn
