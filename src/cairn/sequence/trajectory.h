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

struct StampedPose {
  std::int64_t stamp_ns = 0;
  WorldFromCamera world_from_camera;
};

/// Poses in strictly increasing order of time.
using Trajectory = std::vector<StampedPose>;

/// The pose `t tx ty tz qx qy qz qw` in eight fields of a line, from `first` on. The quaternion is
/// normalised. InputError names the line for what is no number, a place further away than 1e12 m, or a
/// quaternion whose length is not 1 to a hundredth.
[[nodiscard]] StampedPose parse_tum_pose(const TextFile& file, const TextLine& line, std::size_t first,
                                         TimeUnit unit = TimeUnit::second);

/// The pose in the 12 fields of a line: 3x4 world_from_camera by rows, as KITTI has it. InputError names the
/// line for a wrong number of values, what is no number, or no rotation.
[[nodiscard]] WorldFromCamera parse_matrix_pose(const TextFile& file, const TextLine& line);

/// Reads the poses of a file by its content, as read_trajectory_file does, without its warnings: TUM format
/// `t tx ty tz qx qy qz qw` a line, '#' comments, or any other with stamps.
[[nodiscard]] Trajectory read_tum_trajectory(const std::filesystem::path& path);
[[nodiscard]] std::string format_tum_trajectory(const Trajectory& trajectory);

}  // namespace cairn
