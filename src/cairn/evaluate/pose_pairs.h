// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "cairn/geometry/alignment.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Holds estimate and truth of one camera pose.
struct PosePair {
  std::int64_t stamp_ns = 0;  ///< of the estimate
  Rigid3 estimate;            ///< world_from_camera; in the reference's world once aligned
  Rigid3 reference;           ///< world_from_camera
};

/// Pairs poses whose stamps differ by at most `max_gap_s` (seconds, 0 to 1e6), in order of time; closest
/// pairs first, each pose used once, as the TUM benchmark's associate.py does (which leaves out a gap of
/// exactly the limit). evo instead takes for each pose of the trajectory with fewer poses the nearest of the
/// other, and may take one twice; the two agree if the gap is under half the spacing of the stamps.
[[nodiscard]] std::vector<PosePair> pair_poses(const Trajectory& estimate, const Trajectory& reference,
                                               double max_gap_s);

/// Reads pairs that are already associated: 16 values a line, estimate then reference, each as a line of a
/// TUM trajectory. Keeps the order of the lines, whatever the stamps. Throws InputError if a line is not of
/// this layout, a pose is invalid, or there is none.
[[nodiscard]] std::vector<PosePair> read_pose_pairs(const std::filesystem::path& path);

/// Aligns the estimated camera centres to the true ones, reference_from_estimate: see align_points.
[[nodiscard]] Alignment align_pairs(std::span<const PosePair> pairs, bool with_scale);
/// Returns the pairs with their estimates mapped into the reference's world.
[[nodiscard]] std::vector<PosePair> aligned_pairs(const Similarity3& reference_from_estimate,
                                                  std::span<const PosePair> pairs);
/// Computes the root mean square distance of the camera centres, metres; 0 for no pairs.
[[nodiscard]] double rms_distance(std::span<const PosePair> pairs);

}  // namespace cairn
