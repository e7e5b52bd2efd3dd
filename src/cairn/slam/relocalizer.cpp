// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/relocalizer.h"

#include <algorithm>

#include "cairn/core/random.h"

namespace cairn {
namespace {

struct Attempt {
  KeyframeId keyframe;
  Motion motion;
  bool ok = false;
};

void add_candidate(KeyframeId id, std::vector<KeyframeId>& candidates) {
  if (std::find(candidates.begin(), candidates.end(), id) == candidates.end()) candidates.push_back(id);
}

Attempt attempt(const Map& map, KeyframeId keyframe, const ObservedFrame& observed,
                const SlamOptions& options) {
  const auto points = points_of(map, keyframe);
  Attempt one{keyframe, estimate_motion(map.rig(), {map[keyframe].observed, points}, observed, options)};
  const KeyframeDecision decision = decide_loop(one.motion, options);
  one.ok = decision == KeyframeDecision::too_close || decision == KeyframeDecision::keyframe;
  return one;
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

std::optional<Relocalization> relocalize(const Map& map, const PlaceIndex& places,
                                         const ObservedFrame& observed, const SlamOptions& options,
                                         const Executor& executor) {
  const KeyframeId end{static_cast<std::int32_t>(map.keyframes().size())};
  const auto stream =
      0x100000000ULL + static_cast<std::uint64_t>(observed.frame.value);  // apart from the loop closer's
  auto candidates = candidate_keyframes(map, end, options.relocalization_keyframes, options.random_loops,
                                        options.seed, stream);
  for (const PlaceCandidate& place :
       places.query(observed.features.descriptors, static_cast<std::size_t>(options.place_loops)))
    add_candidate({place.id}, candidates);
  const auto attempts = executor.map<Attempt>(
      candidates.size(), [&](std::size_t i) { return attempt(map, candidates[i], observed, options); });
  const auto best =
      std::max_element(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) {
        return (a.ok ? a.motion.inliers : -1) < (b.ok ? b.motion.inliers : -1);
      });
  if (best == attempts.end() || !best->ok) return std::nullopt;
  Relocalization found{best->keyframe,
                       placed_by(map, best->keyframe, best->motion, observed.observations.size())};
  (void)refine_in_map(map, observed, options, found.tracked);  // the match stands without it
  return found;
}

}  // namespace cairn
