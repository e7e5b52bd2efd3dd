// SPDX-License-Identifier: Apache-2.0
#include "slam_outputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/dense/fuse_sequence.h"
#include "cairn/dense/octree_file.h"
#include "cairn/evaluate/evaluation.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/g2o_file.h"
#include "cairn/map_files/map_file.h"
#include "cairn/report/keyframe_report.h"
#include "cairn/report/overview.h"
#include "fusion.h"
#include "map_pictures.h"
#include "parameter_arguments.h"

namespace cairn::app {
namespace {

/// Poses of the keyframes' frames; nothing for all others.
std::vector<std::optional<WorldFromCamera>> keyframe_poses(const Sequence& sequence,
                                                           const SlamResult& result) {
  std::vector<std::optional<WorldFromCamera>> poses(sequence.frames.size());
  const std::int32_t component = result.main_component();
  for (const Keyframe& keyframe : result.map.keyframes()) {
    if (!keyframe.erased && keyframe.component == component && keyframe.observed.frame.valid())
      poses[static_cast<std::size_t>(keyframe.observed.frame.value)] =
          WorldFromCamera(keyframe.world_from_camera);
  }
  return poses;
}

void write_cloud_files(const std::filesystem::path& folder, const Cloud& cloud, const SlamResult& result,
                       double voxel_size) {
  write_cloud(folder / "cloud.ply", cloud);
  write_png(folder / "cloud.png", draw_overview(cloud, main_path(result), voxel_size));
}

}  // namespace

void write_slam_files(const std::filesystem::path& folder, const Sequence& sequence, const SlamResult& result,
                      SlamParameters& parameters) {
  write_file(folder / "trajectory.txt", format_tum_trajectory(result.trajectory()));
  write_file(folder / "keyframes.txt", format_tum_trajectory(result.keyframe_trajectory()));
  if (!result.keyframe_covariances.empty())
    write_file(folder / "keyframe_covariances.csv", format_keyframe_covariances(result));
  write_file(folder / "graph_before.g2o", format_g2o(result.graph_before));
  write_file(folder / "graph_after.g2o", format_g2o(result.graph_after));
  write_file(folder / "frames.csv", format_frames_csv(result));
  write_map(folder / "map", result.map, result.covariances);
  write_map_picture(folder / "map", folder);
  write_file(folder / "camera.yaml", format_calibration(sequence.calibration));
  write_file(folder / "config.yaml", "# Every parameter of this run; cairn slam --config reads it.\n" +
                                         table_of(parameters).format());
}

void write_dense_files(const std::filesystem::path& folder, const Sequence& sequence,
                       const SlamResult& result, const SlamParameters& parameters, const SlamOutputs& wanted,
                       const Executor& executor, Progress& progress, SlamSummary& summary) {
  const auto poses = keyframe_poses(sequence, result);
  const bool has_keyframe =
      std::any_of(poses.begin(), poses.end(), [](const auto& p) { return p.has_value(); });
  if (!has_keyframe || (!wanted.cloud && !wanted.octree)) return;  // none: all was known from the start map
  summary.fused = true;
  summary.has_cloud = wanted.cloud;
  summary.has_octree = wanted.octree;
  const Stopwatch watch;
  CloudBuilder cloud_builder(parameters.cloud);
  OccupancyGrid grid(parameters.octree);
  const FusionTargets targets{wanted.cloud ? &cloud_builder : nullptr, wanted.octree ? &grid : nullptr};
  (void)fuse_sequence(sequence, poses, targets, executor, progress);
  if (wanted.cloud) {
    const Cloud cloud = cloud_builder.take();
    summary.cloud_points = static_cast<std::int64_t>(cloud.points.size());
    write_cloud_files(folder, cloud, result, parameters.cloud.voxel_size);
  }
  if (wanted.octree) {
    write_octree(folder / "octree.ot", grid, octree_contents("octree.ot", grid.colored()));
    const OccupancyGrid::Counts counts = grid.counts();
    summary.occupied_voxels = counts.occupied;
    summary.free_voxels = counts.free;
  }
  summary.fusion_seconds = watch.seconds();
}

void add_accuracy(const Sequence& sequence, const SlamResult& result, SlamSummary& summary) {
  if (!sequence.truth) return;
  const TrajectoryEvaluation evaluation = evaluate_trajectory(result.trajectory(), *sequence.truth);
  if (evaluation.status != EvaluationStatus::ok) return;
  summary.ate_m = evaluation.absolute.ate_m->rmse;
  summary.ate_pairs = static_cast<std::int64_t>(evaluation.pairs.size());
}

}  // namespace cairn::app
