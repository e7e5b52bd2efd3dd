// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/slam_figures.h"

#include <algorithm>

namespace cairn {

FrameCounts count_frames(const SlamResult& result) {
  FrameCounts counts;
  std::vector<int> inliers;
  const std::int32_t main_component = result.main_component();
  for (const TrackingResult& track : result.frames) {
    ++counts.frames;
    counts.relocalized += track.relocalized ? 1 : 0;
    const bool in_main = track.tracked() && result.map.component_of(*track.reference) == main_component;
    counts.tracked += in_main ? 1 : 0;
    counts.elsewhere += track.tracked() && !in_main ? 1 : 0;
    counts.too_far += track.status == TrackingStatus::implausible ? 1 : 0;
    counts.not_matched += track.status == TrackingStatus::lost ? 1 : 0;
    if (track.tracked()) inliers.push_back(track.inliers);
  }
  if (inliers.empty()) return counts;
  const auto middle = inliers.begin() + static_cast<std::ptrdiff_t>(inliers.size() / 2);
  std::nth_element(inliers.begin(), middle, inliers.end());
  counts.median_inliers = *middle;
  return counts;
}

std::vector<std::pair<const char*, const std::vector<double>*>> stages(const StageTimes& times) {
  return {{"decode", &times.decode},   {"features", &times.features}, {"tracking", &times.tracking},
          {"mapping", &times.mapping}, {"loops", &times.loops},       {"window", &times.window},
          {"global", &times.global}};
}

bool is_start_found(const SlamResult& result) {
  return result.start_keyframes > 0 && !result.trajectory().empty() &&
         result.map.component_of({0}) == result.main_component();
}

}  // namespace cairn
