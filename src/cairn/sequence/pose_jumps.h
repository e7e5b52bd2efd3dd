// SPDX-License-Identifier: Apache-2.0
// Private to this room: positions that no vehicle reaches in the time between two poses.
#pragma once

#include <string>

#include "cairn/sequence/given_poses.h"

namespace cairn {

/// Tells whether a motion is faster than 150 m/s and at least a metre long: no vehicle on the ground and no
/// drone comes near this speed, and less than a metre is the noise of two poses in quick succession.
[[nodiscard]] bool is_jump(double metres, double seconds);

/// Describes one jump, to the pose at `stamp`.
[[nodiscard]] std::string describe_jump(double metres, double seconds, const std::string& stamp);
/// Makes a sentence of the first of `count` jumps and its position.
[[nodiscard]] std::string describe_jumps(const std::string& first_jump, int count);

/// Appends a warning if poses jump between frames that follow each other. `source` names their file.
void warn_of_jumps(const std::string& source, const Sequence& sequence, GivenPoses& given);

}  // namespace cairn
