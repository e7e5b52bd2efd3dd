// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/tracker.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/random.h"
#include "cairn/slam/graph_edge.h"

namespace cairn {
namespace {

int points_with_depth(const ObservedFrame& frame) {
  return static_cast<int>(std::count_if(frame.observations.begin(), frame.observations.end(),
                                        [](const Observation& o) { return o.has_disparity(); }));
}

}  // namespace

std::vector<KeyframeId> candidate_keyframes(KeyframeId before, int nearby, int random, std::uint64_t seed,
                                            std::uint64_t stream) {
  std::vector<KeyframeId> candidates;
  const int near_count = std::min(nearby, before.value);
  for (int i = 1; i <= near_count; ++i) candidates.push_back({before.value - i});
  std::vector<std::int32_t> others(static_cast<std::size_t>(before.value - near_count));
  for (std::size_t i = 0; i < others.size(); ++i) others[i] = static_cast<std::int32_t>(i);
  Random numbers(seed, stream);
  const auto wanted = std::min(static_cast<std::size_t>(random), others.size());
  for (std::size_t i = 0; i < wanted; ++i) {  // Fisher-Yates, as far as needed
    std::swap(others[i], others[i + numbers.index(static_cast<std::uint32_t>(others.size() - i))]);
    candidates.push_back({others[i]});
  }
  return candidates;
}

Tracker::Tracker(const RgbdSlamOptions& options, const Executor& executor, KeyframeMap& map,
                 std::vector<PoseGraph::Edge>& edges)
    : options_(options), executor_(executor), map_(map), edges_(edges) {}

const Keyframe& Tracker::keyframe(KeyframeId id) const {
  return map_.keyframes[static_cast<std::size_t>(id.value)];
}

Tracker::Found Tracker::match(KeyframeId reference, const ObservedFrame& frame) const {
  Found found{reference, estimate_motion(map_.rig, keyframe(reference).observed, frame, options_), {}};
  found.decision = decide(found.motion, options_);
  return found;
}

/// Against the reference keyframe; failing that, against the last tracked frame, made a keyframe for it;
/// failing that, against many keyframes.
Tracker::Found Tracker::find_motion(const ObservedFrame& frame) {
  Found found;
  if (!lost_) {
    found = match(reference_, frame);
    if (!found.ok() && previous_) {
      reference_ = add_keyframe(std::move(previous_->observed), previous_->found);
      found = match(reference_, frame);
    }
  }
  previous_.reset();
  if (found.ok()) return found;
  const Found again = relocalize(frame);
  return again.ok() ? again : found;
}

Tracker::Found Tracker::relocalize(const ObservedFrame& frame) const {
  const KeyframeId end{static_cast<std::int32_t>(map_.keyframes.size())};
  const auto stream =
      0x100000000ULL + static_cast<std::uint64_t>(frame.frame.value);  // apart from the loop closer's streams
  const auto candidates = candidate_keyframes(end, options_.relocalization_keyframes, options_.random_loops,
                                              options_.seed, stream);
  const auto found = executor_.map<Found>(candidates.size(), [&](std::size_t i) {
    Found one = match(candidates[i], frame);
    one.decision = decide_loop(one.motion, options_);
    return one;
  });
  const auto best = std::max_element(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return (a.ok() ? a.motion.inliers : -1) < (b.ok() ? b.motion.inliers : -1);
  });
  return best == found.end() ? Found{} : *best;
}

KeyframeId Tracker::add_keyframe(ObservedFrame&& frame, const std::optional<Found>& found) {
  const KeyframeId id{static_cast<std::int32_t>(map_.keyframes.size())};
  Rigid3 world_from_camera;
  if (found) {
    edges_.push_back(make_edge(found->reference, id, found->motion, false));
    world_from_camera =
        keyframe(found->reference).world_from_camera * found->motion.current_from_reference.inverse();
  }
  map_.keyframes.push_back({id, std::move(frame), world_from_camera});
  return id;
}

FrameTrack Tracker::begin_map(ObservedFrame&& frame) {
  FrameTrack track{frame.frame, frame.stamp_ns, {}, false, std::nullopt, {}, 0, 0};
  if (points_with_depth(frame) < options_.min_good_match) return track;
  reference_ = add_keyframe(std::move(frame), std::nullopt);
  track.decision = KeyframeDecision::keyframe;
  track.reference = reference_;
  return track;
}

FrameTrack Tracker::track(ObservedFrame&& frame) {
  if (map_.keyframes.empty()) return begin_map(std::move(frame));
  const bool was_lost = lost_;
  Found found = find_motion(frame);
  FrameTrack track{frame.frame, frame.stamp_ns,       found.decision,      false, std::nullopt,
                   {},          found.motion.matches, found.motion.inliers};
  lost_ = !found.ok();
  if (lost_) return track;
  track.relocalized = was_lost;
  const bool weak = found.motion.inliers < options_.weak_tracking;
  if (found.decision == KeyframeDecision::keyframe || weak) {
    reference_ = add_keyframe(std::move(frame), found);
    track.decision = KeyframeDecision::keyframe;
    track.reference = reference_;
    return track;
  }
  reference_ = found.reference;
  track.reference = found.reference;
  track.reference_from_frame = found.motion.current_from_reference.inverse();
  previous_ = Previous{std::move(frame), std::move(found)};
  return track;
}

}  // namespace cairn
