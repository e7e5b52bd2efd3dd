// SPDX-License-Identifier: Apache-2.0
// Private to this room: positions that no vehicle reaches in the time between two poses.
#pragma once

#include <string>

#include "cairn/sequence/given_poses.h"

namespace cairn {

/// Whether a way is faster than 150 m/s and longer than a metre: no vehicle on the ground and no drone comes
/// near the one, and less than the other is the noise of two poses that follow at once.
[[nodiscard]] bool is_jump(double metres, double seconds);

/// Describes one jump, to the pose at `stamp`.
[[nodiscard]] std::string describe_jump(double metres, double seconds, const std::string& stamp);
/// Makes a sentence of the first of `count` jumps and where it is.
[[nodiscard]] std::string describe_jumps(const std::string& first_jump, int count);

/// Appends a warning if poses jump between frames that follow each other. `source` names their file.
void warn_of_jumps(const std::string& source, const Sequence& sequence, GivenPoses& given);

}  // namespace cairn
