// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/map/map.h"
#include "cairn/map/pose_graph.h"
#include "cairn/observe/row_errors.h"
#include "cairn/optimize/disparity_noise_estimate.h"
#include "cairn/optimize/pose_graph_optimizer.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/disparity_calibrator.h"
#include "cairn/slam/keyframe_covariances.h"
#include "cairn/slam/loop_closer.h"
#include "cairn/slam/options.h"
#include "cairn/slam/stage_times.h"
#include "cairn/slam/tracker.h"

namespace cairn {

/// Holds the result of a run of SLAM.
struct SlamResult {
  std::vector<TrackingResult> frames;   ///< one for each decoded frame, in order
  std::vector<std::string> unreadable;  ///< messages about the frames that were skipped
  Map map;                              ///< map after the last adjustment
  /// Covariances of the landmarks' points, see Mapper::covariances.
  std::vector<Eigen::Matrix3d> covariances;
  /// How sure each keyframe is, by id; empty if the map was not adjusted as a whole (odometry).
  std::vector<KeyframeCovariance> keyframe_covariances;
  PoseGraph graph_before,
      graph_after;  ///< the keyframes by their neighbours and loops; before and after them
  LoopReport loops;
  StageTimes times;
  RowErrors row_errors;       ///< of the right images; all zero if they were not measured
  bool rows_aligned = false;  ///< whether the right images were loaded with their rows corrected
  DisparityCalibration disparity_calibration;  ///< of a stereo pair
  /// Of an RGB-D camera: how sure its disparities are, and how many say so; 0 if it is stated or assumed.
  std::optional<DisparityNoiseEstimate> depth_noise;
  std::size_t start_keyframes = 0;  ///< keyframes of the map that the run started with; 0 without one
  bool stopped = false;             ///< whether the user stopped the run before the last frame

  /// Returns the component of the map with the most tracked frames, which trajectories and outputs are of; 0
  /// if no frame was tracked.
  [[nodiscard]] std::int32_t main_component() const;
  /// Returns world_from_camera of each frame that was tracked in the main component, by its pose relative to
  /// its keyframe.
  [[nodiscard]] Trajectory trajectory() const;
  /// Returns world_from_camera of each keyframe of this sequence in the main component.
  [[nodiscard]] Trajectory keyframe_trajectory() const;
};

/// Runs SLAM on an RGB-D or stereo sequence: observes, tracks, maps, closes loops, adjusts. Reports and skips
/// frames that cannot be decoded. The same bits at any number of threads. A `start` map, of an earlier run,
/// is searched for the camera and extended; its keyframes have no frame in this sequence (FrameId not valid).
/// Throws InputError for a sequence without depth or right images, for options out of range, if no frame can
/// be decoded, and if the `start` map was made with another camera or kind of descriptor.
[[nodiscard]] SlamResult run_slam(const Sequence& sequence, const SlamOptions& options,
                                  const Executor& executor, Progress& progress,
                                  std::optional<Map> start = std::nullopt);

}  // namespace cairn
