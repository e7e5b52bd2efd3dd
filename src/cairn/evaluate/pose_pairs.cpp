// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/pose_pairs.h"

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/sequence/association.h"

namespace cairn {
namespace {

std::vector<std::int64_t> stamps_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(trajectory.size());
  for (const auto& pose : trajectory) stamps.push_back(pose.stamp_ns);
  return stamps;
}

}  // namespace

std::vector<PosePair> pair_poses(const Trajectory& estimate, const Trajectory& reference, double max_gap_s) {
  constexpr double kMaxGap = 1e6;
  require(max_gap_s >= 0 && max_gap_s <= kMaxGap, "max_gap_s is between 0 and 1e6 seconds");
  std::vector<PosePair> pairs;
  for (const auto& [i, j] :
       associate_stamps(stamps_of(estimate), stamps_of(reference), std::llround(1e9 * max_gap_s))) {
    pairs.push_back({estimate[i].stamp_ns, estimate[i].world_from_camera, reference[j].world_from_camera});
  }
  return pairs;
}

}  // namespace cairn
