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

/// By what a pose finds its frame: its time stamp, the number of the frame, or its position in the file, one
/// pose for each frame of the recording.
enum class PoseKey : std::uint8_t { stamp, number, position };

struct TrajectoryFileOptions {
  /// Whole numbers in the first column of a TUM file are numbers of frames, as in sequences without clock.
  bool may_have_numbers = false;
  std::optional<GeodeticOrigin> origin = std::nullopt;  ///< of geodetic poses; none: the file's first pose
};

/// The poses of a file as it states them: of whatever it is of, camera or body.
struct TrajectoryFile {
  /// world_from_camera, or world_from_body; of geodetic poses the world is east, north, up at the origin.
  /// `stamp_ns` is the key: nanoseconds, or the number or position as it is.
  Trajectory poses;
  PoseKey key = PoseKey::stamp;
  /// The key of the file's first row, be it one that was left out as the receiver had no fix yet.
  std::int64_t first_key = 0;
  bool is_of_body = false;  ///< the format says that its poses are of a body, not of a camera
  std::string format;       ///< "TUM", "KITTI", "EuRoC", "OXTS", "table"
  std::optional<GeodeticOrigin> origin;
  std::vector<std::string> warnings;  ///< what a person should know, a sentence each
};

/// Reads poses of any format of docs/poses.md, told by the content. InputError for whatever is wrong.
[[nodiscard]] TrajectoryFile read_trajectory_file(const std::filesystem::path& path,
                                                  const TrajectoryFileOptions& options = {});

/// Whether a folder holds poses: OXTS packets, itself or in oxts/, or a data.csv.
[[nodiscard]] bool is_pose_folder(const std::filesystem::path& folder);

/// Gives poses without time the stamps of a recording's frames, in nanoseconds: `numbers[i]` and `stamps[i]`
/// are of frame i. Poses of other frames are left out. InputError that names `path` if poses go by position
/// and are not as many as the frames, or if none is of one of the frames. Does nothing to poses with stamps.
void stamp_by_frames(const std::filesystem::path& path, const std::vector<std::int64_t>& numbers,
                     const std::vector<std::int64_t>& stamps, TrajectoryFile& file);

}  // namespace cairn
