// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/map/keyframe_map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/slam/motion.h"

namespace cairn {

/// What became of one frame.
struct FrameTrack {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  KeyframeDecision decision = KeyframeDecision::not_matched;
  bool relocalized = false;  ///< found again after being lost
  std::optional<KeyframeId>
      reference;  ///< where the pose is known: relative to this keyframe, its own if it is one
  Rigid3 reference_from_frame;
  int matches = 0;
  int inliers = 0;

  [[nodiscard]] bool tracked() const { return reference.has_value(); }
};

/// Follows the camera from keyframe to keyframe, and adds keyframes and the edges between them.
/// Deterministic.
class Tracker {
 public:
  Tracker(const RgbdSlamOptions& options, const Executor& executor, KeyframeMap& map,
          std::vector<PoseGraph::Edge>& edges);

  /// Takes the next frame. Where it became a keyframe, it is the last of the map.
  FrameTrack track(ObservedFrame&& frame);

 private:
  struct Found {
    KeyframeId reference;
    Motion motion;
    KeyframeDecision decision = KeyframeDecision::not_matched;
    [[nodiscard]] bool ok() const {
      return decision == KeyframeDecision::too_close || decision == KeyframeDecision::keyframe;
    }
  };
  struct Previous {  // the last tracked frame, while it is no keyframe
    ObservedFrame observed;
    Found found;
  };

  [[nodiscard]] const Keyframe& keyframe(KeyframeId id) const;
  [[nodiscard]] Found match(KeyframeId reference, const ObservedFrame& frame) const;
  [[nodiscard]] Found find_motion(const ObservedFrame& frame);
  [[nodiscard]] Found relocalize(const ObservedFrame& frame) const;
  KeyframeId add_keyframe(ObservedFrame&& frame, const std::optional<Found>& found);
  FrameTrack begin_map(ObservedFrame&& frame);

  const RgbdSlamOptions& options_;
  const Executor& executor_;
  KeyframeMap& map_;
  std::vector<PoseGraph::Edge>& edges_;
  KeyframeId reference_;
  std::optional<Previous> previous_;
  bool lost_ = false;
};

/// `nearby` keyframes before `before` (itself excluded), nearest first, then `random` of all earlier ones,
/// drawn without replacement from (seed, stream).
[[nodiscard]] std::vector<KeyframeId> candidate_keyframes(KeyframeId before, int nearby, int random,
                                                          std::uint64_t seed, std::uint64_t stream);

}  // namespace cairn
