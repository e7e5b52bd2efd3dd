// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/map/pose_graph.h"
#include "cairn/slam/frame_pose.h"
#include "cairn/slam/indexed_map.h"
#include "cairn/slam/stage_times.h"
#include "cairn/slam/window.h"

namespace cairn {

/// Lets the map grow by keyframes and keeps it right: landmarks, and after each keyframe an adjustment of the
/// window around it. The adjustment runs beside tracking on a copy; its result is taken over a fixed
/// number of frames after its start, or before the next keyframe, so that the map does not depend on timing.
class Mapper {
 public:
  Mapper(const SlamOptions& options, const Executor& executor, IndexedMap& indexed, StageTimes& times);
  ~Mapper();

  /// The first keyframe of a component, where the frame has enough depth and none fitted for lost_frames.
  std::optional<KeyframeId> begin_component(const ObservedFrame& frame);
  /// The camera is not lost.
  void found() { good_lost_frames_ = 0; }
  /// Makes a keyframe of a tracked frame, with the landmarks that it shows. No adjustment may be under way.
  KeyframeId insert(const ObservedFrame& frame, const FramePose& tracked, KeyframeId parent);
  /// Erases neighbours of the keyframe that have become redundant, and starts the adjustment of the window
  /// around it. No adjustment may be under way.
  void start_adjustment(KeyframeId keyframe);
  /// To be called once for each frame: takes an adjustment over whose time has come. True: the map moved.
  bool apply_adjustment_if_due();
  /// Takes the adjustment over that is under way, if any. True: the map moved.
  bool apply_adjustment();
  /// After the last frame: adjusts the whole map.
  void finish();

  /// After finish: of each landmark's point in the world, square metres, the keyframes taken as exact; zeros
  /// where unknown. None where the map was not adjusted.
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& covariances() const { return covariances_; }
  /// Fills two graphs of the keyframes, joined by odometry and the `loops` given: placed by odometry alone,
  /// and as they are now.
  void fill_graphs(std::span<const PoseGraph::Edge> loops, PoseGraph& before, PoseGraph& after) const;

 private:
  struct Adjustment;
  void adjust_all();
  void adjust_whole(std::int32_t component);
  void put_back(std::int32_t component);
  void keep_covariances(const Window& whole, const BundleReport& report);

  const SlamOptions& options_;
  const Executor& executor_;
  IndexedMap& indexed_;
  Map& map_;
  StageTimes& times_;
  std::unique_ptr<Adjustment> adjustment_;
  std::vector<Eigen::Matrix3d> covariances_;
  struct Step {
    Rigid3 parent_from_new;  // of a first keyframe its place in the world
    Matrix6d information;
  };
  std::vector<Step> odometry_;  // of each keyframe, when it was made
  std::int32_t components_ = 0;
  int good_lost_frames_ = 0;
};

}  // namespace cairn
