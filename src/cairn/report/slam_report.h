// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cairn/report/render.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/slam.h"

namespace cairn {

/// Holds what is told of a SLAM run beside its result.
struct SlamSummary {
  std::string folder;                          ///< of the run, as the user named it
  bool has_cloud = false, has_octree = false;  ///< were written
  std::int64_t cloud_points = 0;
  std::int64_t occupied_voxels = 0, free_voxels = 0;
  bool fused = false;  ///< cloud and octree, as far as wanted, were written
  double fusion_seconds = 0;
  double total_seconds = 0;
  double peak_memory_mb = 0;
  int threads = 1;
  std::uint64_t seed = 1;
  bool odometry = false;
  std::optional<double> ate_m;  ///< RMSE after SE(3) alignment with the sequence's truth, if it has one
  std::int64_t ate_pairs = 0;
};

/// Returns run.json: the figures of the run, with its times.
[[nodiscard]] std::string format_slam_json(const Sequence& sequence, const SlamResult& result,
                                           const SlamSummary& summary);
/// Returns what the program prints in the end, for people.
[[nodiscard]] std::string format_slam_text(const Sequence& sequence, const SlamResult& result,
                                           const SlamSummary& summary);

/// Returns frames.csv: a line of names, then one row for each frame that was decoded: what became of it, the
/// motion since the frame before that was tracked, and its size, rad + m, as max_motion limits it, and that
/// since the keyframe which was the last one then, as keyframe_threshold does.
[[nodiscard]] std::string format_frames_csv(const SlamResult& result);

/// Returns the path of the camera through the main component of the map, with its keyframes, for
/// draw_overview.
[[nodiscard]] CameraPath main_path(const SlamResult& result);

}  // namespace cairn
