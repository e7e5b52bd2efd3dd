// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/loop_closer.h"

#include <algorithm>

#include "cairn/optimize/pose_graph_optimizer.h"
#include "cairn/slam/essential_graph.h"
#include "cairn/slam/local_map.h"
#include "cairn/slam/mapping.h"
#include "cairn/slam/motion_limit.h"
#include "cairn/slam/place_verification.h"
#include "cairn/slam/relocalizer.h"

namespace cairn {
namespace {

/// Returns whether most landmarks that the frame shows at the pose found also fit its present pose.
bool agrees_with_map(const Map& map, KeyframeId keyframe, const FramePose& found) {
  const Rigid3 camera_from_world = map[keyframe].world_from_camera.inverse();
  int seen = 0, fit = 0;
  for (std::size_t i = 0; i < found.landmarks.size(); ++i) {
    if (!found.landmarks[i].valid()) continue;
    ++seen;
    const Observation& observation = map[keyframe].observed.observations[i];
    const Eigen::Vector3d point = camera_from_world * map[found.landmarks[i]].point_in_world;
    fit += squared_error(map.rig(), point, observation) < squared_error_limit(observation) ? 1 : 0;
  }
  return 2 * fit > seen;
}

/// Returns the loop from the current keyframe to a candidate that shows the same place, or nullopt if it is
/// not verified.
std::optional<LoopHypothesis> loop_to(const Map& map, KeyframeId candidate, KeyframeId current,
                                      const SlamOptions& options) {
  const ObservedFrame& observed = map[current].observed;
  auto found = verify_place(map, candidate, observed, options);
  if (!found || !refine_in_map(map, observed, options, *found) || found->inliers < options.loop_min_inliers)
    return std::nullopt;
  const Rigid3 candidate_from_current = map[candidate].world_from_camera.inverse() * found->world_from_camera;
  const bool agrees =
      map[candidate].component == map[current].component && agrees_with_map(map, current, *found);
  return LoopHypothesis{candidate, current, candidate_from_current, found->inliers, agrees};
}

PoseGraph::Edge edge_of(const Map& map, const LoopHypothesis& loop) {
  return {loop.candidate.value, loop.current.value, loop.candidate_from_current,
          edge_information(map, loop.current), false};
}

/// Returns whether the loop strains the edges from the candidate to the current keyframe beyond what they may
/// be wrong by. Other edges are not counted: they hold where they are, and would hide it.
bool is_strained(const PoseGraph& graph, const PoseGraphReport& report, const LoopHypothesis& loop) {
  constexpr double kDegreesOfFreedom = 6;
  constexpr double kMeanSquare = 4.0;  // 2 standard deviations in all edges at once
  const auto [first, last] = std::minmax(loop.candidate.value, loop.current.value);
  const auto is_between = [&, first = first, last = last](const PoseGraph::Edge& edge) {
    return std::min(edge.a, edge.b) >= first && std::max(edge.a, edge.b) <= last;
  };
  const auto edges = std::count_if(graph.edges.begin(), graph.edges.end(), is_between);
  return !(report.chi2_after < kMeanSquare * kDegreesOfFreedom * static_cast<double>(edges));
}

}  // namespace

LoopCloser::LoopCloser(const SlamOptions& options, const Executor& executor, IndexedMap& indexed)
    : options_(options), executor_(executor), places_(indexed.places()), map_(indexed.edit()) {}

std::vector<KeyframeId> LoopCloser::candidates(KeyframeId keyframe) const {
  std::vector<KeyframeId> near = neighbours_of(map_, keyframe);
  near.push_back(keyframe);
  const auto contains = [](const std::vector<KeyframeId>& ids, KeyframeId id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  std::vector<KeyframeId> ids =
      candidate_keyframes(map_, keyframe, options_.nearby_loops, options_.random_loops, options_.seed,
                          static_cast<std::uint64_t>(keyframe.value));
  std::erase_if(ids, [&](KeyframeId id) { return contains(near, id); });
  const auto places = places_.query(map_[keyframe].observed.features.descriptors,
                                    static_cast<std::size_t>(options_.place_loops),
                                    [&](std::int32_t id) { return !contains(near, {id}); });
  for (const PlaceCandidate& place : places)
    if (!contains(ids, {place.id})) ids.push_back({place.id});
  return ids;
}

std::optional<LoopHypothesis> LoopCloser::verify(KeyframeId keyframe) {
  const auto ids = candidates(keyframe);
  const auto loops = executor_.map<std::optional<LoopHypothesis>>(
      ids.size(), [&](std::size_t i) { return loop_to(map_, ids[i], keyframe, options_); });
  report_.tried += static_cast<int>(ids.size());
  std::optional<LoopHypothesis> best;
  for (const auto& loop : loops) {
    if (!loop) continue;
    ++report_.verified;
    if (!best || loop->inliers > best->inliers) best = loop;
  }
  return best;
}

bool LoopCloser::close(KeyframeId keyframe) {
  const auto loop = verify(keyframe);
  if (!loop) return false;
  const LoopVerdict verdict = judge_.judge(map_, *loop);
  if (verdict == LoopVerdict::agrees) {
    fuse_landmarks(*loop);
    ++report_.joined;
    return false;
  }
  if (verdict == LoopVerdict::unconfirmed) {
    ++report_.unconfirmed;
    return false;
  }
  if (verdict == LoopVerdict::believed) --report_.unconfirmed;  // the one before, which it confirms
  const bool same_component = map_[loop->candidate].component == map_[loop->current].component;
  if (verdict == LoopVerdict::implausible || !(same_component ? bend(*loop) : join_components(*loop))) {
    ++report_.rejected;
    return false;
  }
  edges_.push_back(edge_of(map_, *loop));
  fuse_landmarks(*loop);
  return true;
}

/// Moves the younger component, because the world is that of the older one. Returns false and changes nothing
/// if the camera cannot have come from one to the other in the time between.
bool LoopCloser::join_components(const LoopHypothesis& loop) {
  const std::int32_t component = map_[loop.current].component, into = map_[loop.candidate].component;
  const Rigid3 into_from_component = map_[loop.candidate].world_from_camera * loop.candidate_from_current *
                                     map_[loop.current].world_from_camera.inverse();
  if (!can_be_joined(map_, into, component, into_from_component, options_)) return false;
  component > into ? move_component(component, into, into_from_component, map_)
                   : move_component(into, component, into_from_component.inverse(), map_);
  ++report_.components_joined;
  return true;
}

bool LoopCloser::bend(const LoopHypothesis& loop) {
  std::vector<PoseGraph::Edge> loops = edges_;
  loops.push_back(edge_of(map_, loop));
  PoseGraph graph = essential_graph(map_, map_[loop.current].component, loops);
  PoseGraphOptions options;
  options.start = PoseGraphStart::given;
  const PoseGraphReport report = optimize_pose_graph(graph, options);
  if (!report.converged || is_strained(graph, report, loop)) return false;
  move_to(graph, map_);
  ++report_.closed;
  return true;
}

void LoopCloser::fuse_landmarks(const LoopHypothesis& loop) {
  (void)fuse_neighbourhoods(map_, loop.candidate, loop.current, options_);
}

}  // namespace cairn
