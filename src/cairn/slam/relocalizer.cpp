// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/relocalizer.h"

#include <algorithm>

#include "cairn/core/random.h"
#include "cairn/slam/place_verification.h"

namespace cairn {
namespace {

void add_candidate(KeyframeId id, std::vector<KeyframeId>& candidates) {
  if (std::find(candidates.begin(), candidates.end(), id) == candidates.end()) candidates.push_back(id);
}

}  // namespace

std::vector<KeyframeId> candidate_keyframes(const Map& map, KeyframeId before, int nearby, int random,
                                            std::uint64_t seed, std::uint64_t stream) {
  std::vector<KeyframeId> others;
  for (const KeyframeId id : map.keyframe_ids())
    if (id < before) others.push_back(id);
  std::vector<KeyframeId> candidates;
  for (int i = 0; i < nearby && !others.empty(); ++i) {
    candidates.push_back(others.back());
    others.pop_back();
  }
  Random numbers(seed, stream);
  const auto wanted = std::min(static_cast<std::size_t>(random), others.size());
  for (std::size_t i = 0; i < wanted; ++i) {  // Fisher-Yates, as far as needed
    std::swap(others[i], others[i + numbers.index(static_cast<std::uint32_t>(others.size() - i))]);
    candidates.push_back(others[i]);
  }
  return candidates;
}

std::optional<Relocalization> relocalize(const IndexedMap& indexed, const ObservedFrame& observed,
                                         const SlamOptions& options, const Executor& executor) {
  const Map& map = indexed.map();
  const KeyframeId end{static_cast<std::int32_t>(map.keyframes().size())};
  const auto stream =
      0x100000000ULL + static_cast<std::uint64_t>(observed.frame.value);  // apart from the loop closer's
  auto candidates = candidate_keyframes(map, end, options.relocalization_keyframes, options.random_loops,
                                        options.seed, stream);
  for (const PlaceCandidate& place :
       indexed.places().query(observed.features.descriptors, static_cast<std::size_t>(options.place_loops)))
    add_candidate({place.id}, candidates);
  using Placed = std::optional<FramePose>;
  const auto attempts = executor.map<Placed>(
      candidates.size(), [&](std::size_t i) { return verify_place(map, candidates[i], observed, options); });
  const auto best = std::max_element(attempts.begin(), attempts.end(), [](const Placed& a, const Placed& b) {
    return (a ? a->inliers : -1) < (b ? b->inliers : -1);
  });
  if (best == attempts.end() || !*best) return std::nullopt;
  Relocalization found{candidates[static_cast<std::size_t>(best - attempts.begin())], **best};
  (void)refine_in_map(map, observed, options, found.tracked);  // the match stands without it
  return found;
}

}  // namespace cairn
