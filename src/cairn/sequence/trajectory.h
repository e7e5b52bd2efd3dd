// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/geometry/framed.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {

/// Holds a pose and its time.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  WorldFromCamera world_from_camera;
};

/// Poses in strictly increasing order of time.
using Trajectory = std::vector<StampedPose>;

/// Parses the pose `t tx ty tz qx qy qz qw` in eight fields of a line, from `first` on. Normalises the
/// quaternion. Throws InputError with the line if a field is not a number, a coordinate is above 1e12 m, or
/// the quaternion's length is not 1 within a hundredth.
[[nodiscard]] StampedPose parse_tum_pose(const TextFile& file, const TextLine& line, std::size_t first,
                                         TimeUnit unit = TimeUnit::second);

/// Parses the pose in the 12 fields of a line: 3x4 world_from_camera by rows, as KITTI has it. Throws
/// InputError with the line for a wrong number of values, a field that is not a number, or no rotation.
[[nodiscard]] WorldFromCamera parse_matrix_pose(const TextFile& file, const TextLine& line);

/// Reads the poses of a file by its content, as read_trajectory_file does, without its warnings: TUM format
/// `t tx ty tz qx qy qz qw` a line, '#' comments, or any other with stamps.
[[nodiscard]] Trajectory read_tum_trajectory(const std::filesystem::path& path);
/// Formats poses in TUM format, `t tx ty tz qx qy qz qw` a line.
[[nodiscard]] std::string format_tum_trajectory(const Trajectory& trajectory);

}  // namespace cairn
