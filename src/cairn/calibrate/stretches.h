// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Holds the motion of the camera from one frame to another.
struct Stretch {
  std::int64_t first_ns = 0, last_ns = 0;  ///< stamps of the two frames
  Rigid3 first_from_last;
};

/// Cuts a trajectory into stretches that follow one another without overlap, so that their errors have little
/// in common: each of a twentieth of the whole time, but of 0.5 to 2 s, or of two neighbouring frames where
/// these are further apart, up to 3 s. Leaves out stretches over missing frames (gaps of more than three
/// times the median) and those with less than a fifth of the usual motion (the 0.9 quantile of both length
/// and angle), which say nothing.
[[nodiscard]] std::vector<Stretch> cut_stretches(const Trajectory& trajectory);

}  // namespace cairn
