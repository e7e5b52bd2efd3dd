// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/map/map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/optimize/pose_graph_optimizer.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/loop_closer.h"
#include "cairn/slam/options.h"
#include "cairn/slam/stage_times.h"
#include "cairn/slam/tracker.h"

namespace cairn {

struct SlamResult {
  std::vector<TrackingResult> frames;        ///< one for each frame that was decoded, in order
  std::vector<std::string> unreadable;       ///< messages of frames that were skipped
  Map map;                                   ///< after the last adjustment
  std::vector<Eigen::Matrix3d> covariances;  ///< of its landmarks' points, see Mapper::covariances
  PoseGraph graph_before,
      graph_after;  ///< the keyframes by their neighbours and loops; before and after them
  LoopReport loops;
  StageTimes times;
  std::size_t start_keyframes = 0;  ///< of the map that the run went on from; 0: it began with none
  bool stopped = false;             ///< the user stopped before the last frame

  /// The component of the map with the most frames: the one that trajectories and outputs are of.
  [[nodiscard]] std::int32_t main_component() const;
  /// world_from_camera of every frame that was tracked in the main component, carried by its keyframe's pose.
  [[nodiscard]] Trajectory trajectory() const;
  [[nodiscard]] Trajectory keyframe_trajectory() const;
};

/// SLAM with an RGB-D or stereo sequence: observe, track, map, close loops, adjust. A frame that cannot be
/// decoded is reported and skipped; where none can, that is an InputError. The same bits at any number of
/// threads. InputError for a sequence without depth or right images and for options out of range. With a
/// `start` map, of an earlier run, the camera is looked for in it, and the map goes on growing; its keyframes
/// have no frame in this sequence (FrameId not valid). InputError where it was made with another camera or
/// another kind of descriptor.
[[nodiscard]] SlamResult run_slam(const Sequence& sequence, const SlamOptions& options,
                                  const Executor& executor, Progress& progress,
                                  std::optional<Map> start = std::nullopt);

}  // namespace cairn
