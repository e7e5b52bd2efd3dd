// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/map/keyframe_map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/optimize/pose_graph_optimizer.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/loop_closer.h"
#include "cairn/slam/options.h"
#include "cairn/slam/tracker.h"

namespace cairn {

/// Wall-clock seconds by stage; `frontend` (decoding and features) is summed over frames, as it runs beside
/// tracking.
struct StageSeconds {
  double decode = 0, features = 0, tracking = 0, loops = 0, graph = 0;
};

struct RgbdSlamResult {
  std::vector<FrameTrack> frames;       ///< one for each frame that was decoded, in order
  std::vector<std::string> unreadable;  ///< messages of frames that were skipped
  KeyframeMap map;                      ///< poses after optimisation
  PoseGraph graph_before, graph_after;
  PoseGraphReport graph_report;  ///< of the optimisation, where there was one
  LoopReport loops;
  StageSeconds seconds;
  bool stopped = false;  ///< the user stopped before the last frame

  /// world_from_camera of every frame that was tracked, carried by its keyframe's optimised pose.
  [[nodiscard]] Trajectory trajectory() const;
  [[nodiscard]] Trajectory keyframe_trajectory() const;
};

/// RGB-D SLAM without given poses: observe, track, decide, close loops, optimise. A frame that cannot be
/// decoded is reported and skipped. The same bits at any number of threads. InputError for a sequence without
/// depth and for options out of range.
[[nodiscard]] RgbdSlamResult run_rgbd_slam(const Sequence& sequence, const RgbdSlamOptions& options,
                                           const Executor& executor, Progress& progress);

}  // namespace cairn
