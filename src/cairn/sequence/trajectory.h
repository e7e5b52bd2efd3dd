// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  Rigid3 world_from_camera;
};

/// Poses in strictly increasing order of time.
using Trajectory = std::vector<StampedPose>;

/// TUM format: `t tx ty tz qx qy qz qw` a line, t in seconds, '#' comments. InputError names the line for a
/// wrong number of values, a quaternion of length 0 or a stamp that does not increase. Quaternions are
/// normalised.
[[nodiscard]] Trajectory read_tum_trajectory(const std::filesystem::path& path);
[[nodiscard]] std::string format_tum_trajectory(const Trajectory& trajectory);

}  // namespace cairn
