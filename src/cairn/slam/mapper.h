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
#include "cairn/slam/keyframe_covariances.h"
#include "cairn/slam/stage_times.h"
#include "cairn/slam/window.h"

namespace cairn {

/// Extends the map by keyframes and landmarks, and after each keyframe adjusts the window around it. The
/// adjustment runs beside tracking on a copy; its result is applied a fixed number of frames after its start,
/// or before the next keyframe, so that the map does not depend on timing.
class Mapper {
 public:
  Mapper(const SlamOptions& options, const Executor& executor, IndexedMap& indexed, StageTimes& times);
  ~Mapper();

  /// Makes a frame that could not be tracked the first keyframe of a new component. Returns nullopt if fewer
  /// than min_matches of its features have a depth, or if the map has keyframes and fewer than lost_frames
  /// such frames have come since the last call of found().
  std::optional<KeyframeId> begin_component(const ObservedFrame& frame);
  /// Restarts the count of lost frames; to be called for each tracked frame.
  void found() { good_lost_frames_ = 0; }
  /// Makes a keyframe of a tracked frame, in the component of `parent`: adds landmarks by depth and fuses
  /// duplicates. Throws PreconditionError if an adjustment is running.
  KeyframeId insert(const ObservedFrame& frame, const FramePose& tracked, KeyframeId parent);
  /// Erases redundant neighbours of the keyframe (cull_keyframes), and starts the adjustment of the window
  /// around it. Throws PreconditionError if an adjustment is running.
  void start_adjustment(KeyframeId keyframe);
  /// Applies the running adjustment if more than window_lag frames have come since its start. To be called
  /// once for each frame. Returns whether the map moved.
  bool apply_adjustment_if_due();
  /// Waits for the running adjustment, if any, and applies it. Returns whether the map moved.
  bool apply_adjustment();
  /// Applies the running adjustment, adjusts each component as a whole unless `odometry` is set, and moves
  /// each back to where its first keyframe was made. To be called after the last frame. `field` says whether
  /// a field was taken off the map's disparities.
  void finish(SharedField field = SharedField::none);

  /// Returns, after finish(), the covariance of each landmark's point in the world by id, square metres, with
  /// the keyframes taken as exact; zeros if it is unknown. Empty if `odometry` is set.
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& covariances() const { return covariances_; }
  /// Returns, after finish(), how sure each keyframe is, by id. Empty if `odometry` is set.
  [[nodiscard]] const std::vector<KeyframeCovariance>& keyframe_covariances() const {
    return keyframe_covariances_;
  }
  /// Fills two pose graphs of all keyframes with the edge from the parent of each and the given `loops`:
  /// `before` has the poses by odometry alone, its edges and their assumed information (edge_information),
  /// `after` the present poses. After finish() it also has the edges between keyframes that are left as they
  /// are placed, with the information of the adjustment.
  void fill_graphs(std::span<const PoseGraph::Edge> loops, PoseGraph& before, PoseGraph& after) const;

 private:
  struct Adjustment;
  void adjust_all(SharedField field);
  void adjust_whole(std::int32_t component, SharedField field);
  void put_back(std::int32_t component);
  void keep_covariances(const Window& whole, const BundleReport& report, SharedField field);
  void place_edges(PoseGraph& graph) const;

  const SlamOptions& options_;
  const Executor& executor_;
  IndexedMap& indexed_;
  Map& map_;
  StageTimes& times_;
  std::unique_ptr<Adjustment> adjustment_;
  std::vector<Eigen::Matrix3d> covariances_;
  std::vector<KeyframeCovariance> keyframe_covariances_;
  struct Step {
    Rigid3 parent_from_new;  // world_from_new of a first keyframe
    Matrix6d information;
  };
  std::vector<Step> odometry_;  // of each keyframe, when it was made
  std::int32_t components_ = 0;
  int good_lost_frames_ = 0;
};

}  // namespace cairn
