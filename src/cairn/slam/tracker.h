// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/executor.h"
#include "cairn/slam/indexed_map.h"
#include "cairn/slam/motion_limit.h"
#include "cairn/slam/tracked_frame.h"

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

/// Follows the camera through the map: predicts the pose by the last motion, finds in the image what the last
/// frame showed, then what the map around it holds, and solves for the pose of the camera. Falls back to
/// matching without prediction, then to relocalisation. A pose too far from the last one known (max_motion)
/// is refused, whichever of them found it. It reads the map and never writes it. Deterministic.
class Tracker {
 public:
  Tracker(const SlamOptions& options, const Executor& executor, const IndexedMap& indexed);

  /// The pose of the next frame, which stays here as last(). Its decision is keyframe where one is due.
  FrameTrack track(ObservedFrame&& frame);
  /// The last frame that was given to track or begin, and what is known of it; meaningful while not lost.
  [[nodiscard]] const ObservedFrame& last_observed() const { return observed_; }
  [[nodiscard]] const TrackedFrame& last() const { return last_; }
  [[nodiscard]] KeyframeId reference() const { return reference_; }
  [[nodiscard]] bool lost() const { return lost_; }

  /// The last frame has become this keyframe.
  void refer_to(KeyframeId keyframe);
  /// The map's poses and landmarks have been adjusted: the last frame moves with its reference.
  void follow_map();

 private:
  [[nodiscard]] std::optional<TrackedFrame> follow_motion(const ObservedFrame& frame) const;
  [[nodiscard]] std::optional<TrackedFrame> match_last(const ObservedFrame& frame, FrameTrack& track) const;
  [[nodiscard]] std::optional<TrackedFrame> follow(const ObservedFrame& frame, FrameTrack& track) const;
  [[nodiscard]] std::optional<TrackedFrame> find_again(const ObservedFrame& frame, FrameTrack& track);
  [[nodiscard]] bool admit(const ObservedFrame& frame, const TrackedFrame& current, KeyframeId reference,
                           FrameTrack& track) const;
  [[nodiscard]] std::vector<FoundPoint> find_shown_before(const PosedFrame& frame, double radius_px) const;
  [[nodiscard]] bool is_keyframe_due(const ObservedFrame& frame, const TrackedFrame& current) const;
  void refer_to_best(const TrackedFrame& current);
  void accept(ObservedFrame&& frame, TrackedFrame&& current, FrameTrack& track);

  const SlamOptions& options_;
  const Executor& executor_;
  const IndexedMap& indexed_;
  const Map& map_;
  KeyframeId reference_;
  ObservedFrame observed_;
  TrackedFrame last_;
  Rigid3 reference_from_last_;
  Rigid3 current_from_last_;  // the last motion, with which the next one is predicted
  KnownPoses known_;
  bool motion_known_ = false;
  bool lost_ = true;
};

}  // namespace cairn
