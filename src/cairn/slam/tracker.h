// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/executor.h"
#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"
#include "cairn/slam/motion_limit.h"

namespace cairn {

/// What became of one frame.
struct TrackingResult {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  TrackingStatus status = TrackingStatus::lost;
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

  /// Tracks the next frame, which stays here as last(). Its status is keyframe if one is due.
  TrackingResult track(ObservedFrame&& frame);
  /// The last frame that was given to track or begin, and what is known of it; meaningful while not lost.
  [[nodiscard]] const ObservedFrame& last_observed() const { return observed_; }
  [[nodiscard]] const FramePose& last() const { return last_; }
  [[nodiscard]] KeyframeId reference() const { return reference_; }
  [[nodiscard]] bool lost() const { return lost_; }

  /// The last frame has become this keyframe.
  void refer_to(KeyframeId keyframe);
  /// The map's poses and landmarks have been adjusted: the last frame moves with its reference.
  void follow_map();

 private:
  [[nodiscard]] std::optional<FramePose> follow_motion(const ObservedFrame& frame) const;
  [[nodiscard]] std::optional<FramePose> match_last(const ObservedFrame& frame, TrackingResult& track) const;
  [[nodiscard]] std::optional<FramePose> follow(const ObservedFrame& frame, TrackingResult& track) const;
  [[nodiscard]] std::optional<FramePose> find_again(const ObservedFrame& frame, TrackingResult& track);
  [[nodiscard]] bool admit(const ObservedFrame& frame, const FramePose& current, KeyframeId reference,
                           TrackingResult& track) const;
  [[nodiscard]] std::vector<Correspondence> find_shown_before(const PosedFrame& frame,
                                                              double radius_px) const;
  [[nodiscard]] bool is_keyframe_due(const ObservedFrame& frame, const FramePose& current) const;
  void refer_to_best(const FramePose& current);
  void accept(ObservedFrame&& frame, FramePose&& current, TrackingResult& track);

  const SlamOptions& options_;
  const Executor& executor_;
  const IndexedMap& indexed_;
  const Map& map_;
  KeyframeId reference_;
  ObservedFrame observed_;
  FramePose last_;
  Rigid3 reference_from_last_;
  Rigid3 current_from_last_;  // the last motion, with which the next one is predicted
  KnownPoses known_;
  bool motion_known_ = false;
  bool lost_ = true;
};

}  // namespace cairn
