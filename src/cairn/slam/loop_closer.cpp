// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/loop_closer.h"

#include <algorithm>

#include "cairn/slam/graph_edge.h"
#include "cairn/slam/motion.h"
#include "cairn/slam/tracker.h"

namespace cairn {
namespace {

bool joined(const std::vector<PoseGraph::Edge>& edges, KeyframeId a, KeyframeId b) {
  return std::any_of(edges.rbegin(), edges.rend(),
                     [&](const PoseGraph::Edge& edge) { return edge.a == a.value && edge.b == b.value; });
}

}  // namespace

LoopReport close_loops(const KeyframeMap& map, const RgbdSlamOptions& options, const Executor& executor,
                       std::vector<PoseGraph::Edge>& edges) {
  const Keyframe& current = map.keyframes.back();
  auto candidates = candidate_keyframes(current.id, options.nearby_loops, options.random_loops, options.seed,
                                        static_cast<std::uint64_t>(current.id.value));
  std::erase_if(candidates, [&](KeyframeId id) { return joined(edges, id, current.id); });
  const auto motions = executor.map<Motion>(candidates.size(), [&](std::size_t i) {
    const Keyframe& candidate = map.keyframes[static_cast<std::size_t>(candidates[i].value)];
    return estimate_motion(map.rig, candidate.observed, current.observed, options);
  });
  LoopReport report;
  report.tried = static_cast<int>(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const KeyframeDecision decision = decide_loop(motions[i], options);
    if (decision == KeyframeDecision::not_matched || decision == KeyframeDecision::too_far) continue;
    edges.push_back(make_edge(candidates[i], current.id, motions[i], true));
    const bool nearby = current.id.value - candidates[i].value <= options.nearby_loops;
    ++(nearby ? report.nearby : report.far);
  }
  return report;
}

}  // namespace cairn
