// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cairn/core/executor.h"
#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"
#include "cairn/slam/motion_limit.h"

namespace cairn {

/// Holds the result of tracking one frame.
struct TrackingResult {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  TrackingStatus status = TrackingStatus::lost;
  bool relocalized = false;             ///< found by relocalisation, that is, without a prediction
  std::optional<KeyframeId> reference;  ///< keyframe that the pose is relative to, its own if it is one;
                                        ///< nullopt if the pose is not known
  Rigid3 reference_from_frame;
  int matches = 0;
  int inliers = 0;

  [[nodiscard]] bool tracked() const { return reference.has_value(); }
};

/// Tracks the camera in the map: predicts the pose by the last motion, searches the image for what the last
/// frame showed, then for landmarks of the map around it, and solves for the pose. Falls back to matching
/// without prediction, then to relocalisation. A pose too far from the last known one (max_motion) is
/// refused, however it was found. Reads the map and never writes it. Deterministic.
class Tracker {
 public:
  Tracker(const SlamOptions& options, const Executor& executor, const IndexedMap& indexed);

  /// Tracks the next frame and keeps it as last_observed(). The status is keyframe if a keyframe is due.
  TrackingResult track(ObservedFrame&& frame);
  /// Returns the last frame that was given to track().
  [[nodiscard]] const ObservedFrame& last_observed() const { return observed_; }
  /// Takes a field off the disparities of the last frame (correct_disparities).
  void correct_disparities(const DisparityField& field, double min_sigmas) {
    cairn::correct_disparities(map_.rig(), field, min_sigmas, observed_);
  }
  /// Sets the standard deviations of the last frame's disparities to those of `noise`.
  void weigh_disparities(const DisparityNoise& noise) {
    cairn::weigh_disparities(map_.rig(), noise, observed_);
  }
  /// Returns the pose and landmarks of the last frame; meaningful unless lost().
  [[nodiscard]] const FramePose& last() const { return last_; }
  /// Returns the keyframe that the last frame's pose is relative to; meaningful unless lost().
  [[nodiscard]] KeyframeId reference() const { return reference_; }
  [[nodiscard]] bool lost() const { return lost_; }

  /// Makes `keyframe`, made of the last frame, its reference; the camera is not lost afterwards.
  void refer_to(KeyframeId keyframe);
  /// Moves the last frame with its reference; to be called after the map was adjusted.
  void follow_map();

 private:
  [[nodiscard]] std::optional<FramePose> follow_from(const PosedFrame& frame, double radius_px) const;
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
