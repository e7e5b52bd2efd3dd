// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/geometry/geodetic.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Names how a pose is assigned to its frame: by its time stamp, the number of the frame, or its position in
/// the file, one pose for each frame of the recording.
enum class PoseKey : std::uint8_t { stamp, number, position };

/// Sets how a file of poses is read.
struct TrajectoryFileOptions {
  /// If true, whole numbers in the first column of a TUM file are numbers of frames, as in sequences without
  /// clock.
  bool may_have_numbers = false;
  std::optional<GeodeticOrigin> origin = std::nullopt;  ///< of geodetic poses; nullopt: the file's first pose
};

/// Holds the poses of a file as it states them, of a camera or a body.
struct TrajectoryFile {
  /// world_from_camera, or world_from_body; of geodetic poses the world is east, north, up at the origin.
  /// `stamp_ns` is the key: nanoseconds, or the number or position as it is.
  Trajectory poses;
  PoseKey key = PoseKey::stamp;
  /// Key of the file's first row, even if it was left out because the receiver had no fix yet.
  std::int64_t first_key = 0;
  bool is_of_body = false;  ///< the format states poses of a body, not of a camera
  std::string format;       ///< "TUM", "KITTI", "EuRoC", "OXTS", "table"
  std::optional<GeodeticOrigin> origin;
  std::vector<std::string> warnings;  ///< what a person should know, a sentence each
};

/// Reads poses of any format of docs/poses.md, recognised by the content. Throws InputError for any defect.
[[nodiscard]] TrajectoryFile read_trajectory_file(const std::filesystem::path& path,
                                                  const TrajectoryFileOptions& options = {});

/// Tells whether a folder holds poses: OXTS packets, itself or in oxts/, or a data.csv.
[[nodiscard]] bool is_pose_folder(const std::filesystem::path& folder);

/// Assigns to poses without time the stamps of a recording's frames, in nanoseconds: `numbers[i]` and
/// `stamps[i]` are of frame i. Leaves out poses of other frames. Does nothing to poses with stamps. Throws
/// InputError that names `path` if poses go by position and are not as many as the frames, or if none is of
/// one of the frames.
void stamp_by_frames(const std::filesystem::path& path, const std::vector<std::int64_t>& numbers,
                     const std::vector<std::int64_t>& stamps, TrajectoryFile& file);

}  // namespace cairn
