// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Estimate and truth of one camera pose.
struct PosePair {
  std::int64_t stamp_ns = 0;  ///< of the estimate
  Rigid3 estimate;            ///< world_from_camera; in the reference's world once aligned
  Rigid3 reference;           ///< world_from_camera
};

/// Poses whose stamps differ by at most `max_gap_s` (seconds, >= 0), in order of time; closest pairs first,
/// each pose used once, as the TUM benchmark's associate.py does (which leaves out a gap of exactly the
/// limit). evo instead takes for each pose of the trajectory with fewer poses the nearest of the other, and
/// may take one twice; the two agree wherever the gap is under half the spacing of the stamps.
[[nodiscard]] std::vector<PosePair> pair_poses(const Trajectory& estimate, const Trajectory& reference,
                                               double max_gap_s);

}  // namespace cairn
