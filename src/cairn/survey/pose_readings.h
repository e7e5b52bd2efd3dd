// SPDX-License-Identifier: Apache-2.0
// Private to this room.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

using CameraPoses = std::vector<std::optional<WorldFromCamera>>;

/// Describes another way to read the given poses.
struct PoseReading {
  std::string name;          ///< "quaternions as qw qx qy qz"
  std::string remedy;        ///< what the user has to change if it is the right one
  bool is_combined = false;  ///< whether it takes two misreadings at once
  CameraPoses poses;         ///< of each frame, by this reading
};

/// Returns the readings that are known to be mistaken for the given one, by the format of the poses: orders
/// of quaternions, inverse transforms, axes of the body or the camera, senses and units of angles, exchanged
/// coordinates, poses of neighbouring frames.
[[nodiscard]] std::vector<PoseReading> other_readings(const Sequence& sequence, const GivenPoses& given);

}  // namespace cairn
