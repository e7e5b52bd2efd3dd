// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/guided_matching.h"

#include "cairn/core/error.h"
#include "cairn/features/keypoint_grid.h"
#include "cairn/matching/matching_candidates.h"
#include "cairn/matching/packed_descriptors.h"

namespace cairn {
std::vector<Match> match_predicted(const std::vector<SearchWindow>& places, const Descriptors& descriptors,
                                   const Features& features, const MatchOptions& options,
                                   const Executor& executor) {
  options.validate();
  require(places.size() == descriptors.count(), "each place has a descriptor");
  if (places.empty() || features.keypoints.empty()) return {};
  require_comparable(descriptors, features.descriptors);
  const KeypointGrid grid(features.keypoints);
  const auto find = [&](std::size_t p, Candidates& candidates) {
    const SearchWindow& place = places[p];
    grid.find(place.u, place.v, place.radius_px, candidates.trains);
    std::erase_if(candidates.trains, [&](std::int32_t i) {
      const auto size = static_cast<double>(features.keypoints[static_cast<std::size_t>(i)].size);
      return !(size >= place.min_size && size <= place.max_size);
    });
    candidates.measure(descriptors, p, features.descriptors);
  };
  return without_gaps(match_candidates(places.size(), features.keypoints.size(), descriptors.norm(), find,
                                       options, executor));
}

}  // namespace cairn
