// SPDX-License-Identifier: Apache-2.0
#include "slam_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/dense/fuse_sequence.h"
#include "cairn/dense/octree_file.h"
#include "cairn/evaluate/evaluation.h"
#include "cairn/image/codec.h"
#include "cairn/map/g2o_file.h"
#include "cairn/map/map_file.h"
#include "cairn/report/overview.h"
#include "fusion.h"
#include "map_pictures.h"

namespace cairn::app {
namespace {

struct FrameCounts {
  std::int64_t frames = 0, tracked = 0, elsewhere = 0, relocalized = 0, too_far = 0, not_matched = 0;
  int median_inliers = 0;
};

FrameCounts count_frames(const SlamResult& result) {
  FrameCounts counts;
  std::vector<int> inliers;
  const std::int32_t main_part = result.main_part();
  for (const FrameTrack& track : result.frames) {
    ++counts.frames;
    counts.relocalized += track.relocalized ? 1 : 0;
    const bool in_main = track.tracked() && result.map.part_of(*track.reference) == main_part;
    counts.tracked += in_main ? 1 : 0;
    counts.elsewhere += track.tracked() && !in_main ? 1 : 0;
    counts.too_far += track.decision == KeyframeDecision::too_far ? 1 : 0;
    counts.not_matched += track.decision == KeyframeDecision::not_matched ? 1 : 0;
    if (track.tracked()) inliers.push_back(track.inliers);
  }
  if (!inliers.empty()) {
    const auto middle = inliers.begin() + static_cast<std::ptrdiff_t>(inliers.size() / 2);
    std::nth_element(inliers.begin(), middle, inliers.end());
    counts.median_inliers = *middle;
  }
  return counts;
}

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// The stages by their names, in the order of the data.
std::vector<std::pair<const char*, const std::vector<double>*>> stages(const StageTimes& times) {
  return {{"decode", &times.decode},   {"features", &times.features}, {"tracking", &times.tracking},
          {"mapping", &times.mapping}, {"loops", &times.loops},       {"window", &times.window},
          {"global", &times.global}};
}

nlohmann::ordered_json to_json(const TimeSummary& time) {
  return {{"total_s", time.total},
          {"median_ms", 1e3 * time.median},
          {"percentile_95_ms", 1e3 * time.percentile_95}};
}

/// Poses of the keyframes' frames; nothing for all others.
std::vector<std::optional<WorldFromCamera>> keyframe_poses(const Sequence& sequence,
                                                           const SlamResult& result) {
  std::vector<std::optional<WorldFromCamera>> poses(sequence.frames.size());
  const std::int32_t part = result.main_part();
  for (const Keyframe& keyframe : result.map.keyframes()) {
    if (!keyframe.erased && keyframe.part == part && keyframe.observed.frame.valid())
      poses[static_cast<std::size_t>(keyframe.observed.frame.value)] =
          WorldFromCamera(keyframe.world_from_camera);
  }
  return poses;
}

CameraPath path_of(const SlamResult& result) {
  CameraPath path;
  const std::int32_t part = result.main_part();
  for (const FrameTrack& track : result.frames) {
    if (!track.tracked() || result.map.part_of(*track.reference) != part) continue;
    const Keyframe& reference = result.map[*track.reference];
    const bool is_keyframe = track.frame == reference.observed.frame && !reference.erased;
    if (is_keyframe) path.keyframes.push_back(path.world_from_camera.size());
    path.world_from_camera.push_back(result.map.world_from_camera(reference.id) * track.reference_from_frame);
  }
  return path;
}

/// One row per frame: what became of it.
std::string format_frames_csv(const SlamResult& result) {
  std::string text = "frame,stamp_s,outcome,relocalized,part,reference_keyframe,matches,inliers\n";
  for (const FrameTrack& track : result.frames) {
    const std::string part = track.reference ? fmt::format("{}", result.map.part_of(*track.reference)) : "";
    const std::string reference = track.reference ? fmt::format("{}", track.reference->value) : "";
    text += fmt::format("{},{},{},{},{},{},{},{}\n", track.frame.value, format_stamp(track.stamp_ns),
                        to_string(track.decision), track.relocalized ? 1 : 0, part, reference, track.matches,
                        track.inliers);
  }
  return text;
}

void write_cloud_files(const std::filesystem::path& folder, const Cloud& cloud, const SlamResult& result,
                       double voxel_size) {
  write_cloud(folder / "cloud.ply", cloud);
  write_png(folder / "cloud.png", draw_overview(cloud, path_of(result), voxel_size));
}

/// Whether the camera was found in the map that the run went on from.
bool is_start_found(const SlamResult& result) {
  return result.start_keyframes > 0 && !result.trajectory().empty() &&
         result.map.part_of({0}) == result.main_part();
}

void print_start(const SlamResult& result) {
  if (!is_start_found(result)) {
    fmt::print(
        "start map    not recognised: the trajectory is in a world of its own, a new part of the map\n");
    return;
  }
  const std::int32_t part = result.main_part();
  const auto in_main = [&](const FrameTrack& track) {
    return track.tracked() && result.map.part_of(*track.reference) == part;
  };
  const auto first = std::find_if(result.frames.begin(), result.frames.end(), in_main);
  fmt::print("start map    recognised; the trajectory is in its world, from frame {} on\n",
             first->frame.value);
}

}  // namespace

void write_slam_files(const std::filesystem::path& folder, const Sequence& sequence, const SlamResult& result,
                      SlamParameters& parameters) {
  write_file(folder / "trajectory.txt", format_tum_trajectory(result.trajectory()));
  write_file(folder / "keyframes.txt", format_tum_trajectory(result.keyframe_trajectory()));
  write_file(folder / "graph_before.g2o", format_g2o(result.graph_before));
  write_file(folder / "graph_after.g2o", format_g2o(result.graph_after));
  write_file(folder / "frames.csv", format_frames_csv(result));
  write_map(folder / "map", result.map, result.covariances);
  write_map_picture(folder / "map", folder);
  write_file(folder / "camera.yaml", format_calibration(sequence.calibration));
  write_file(folder / "config.yaml",
             "# Every parameter of this run; cairn slam --config reads it.\n" + parameters.table().format());
}

void write_dense_files(const std::filesystem::path& folder, const Sequence& sequence,
                       const SlamResult& result, const SlamParameters& parameters, const SlamOutputs& wanted,
                       const Executor& executor, Progress& progress, SlamSummary& summary) {
  const auto poses = keyframe_poses(sequence, result);
  const bool has_keyframe =
      std::any_of(poses.begin(), poses.end(), [](const auto& p) { return p.has_value(); });
  if (!has_keyframe || (!wanted.cloud && !wanted.octree)) return;  // none: all was known from the start map
  summary.fused = true;
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

std::string format_run_json(const Sequence& sequence, const SlamResult& result, const SlamSummary& summary) {
  const FrameCounts counts = count_frames(result);
  nlohmann::ordered_json json;
  json["cairn"] = CAIRN_VERSION;
  json["sequence"] = sequence.folder.string();
  json["frames"] = {
      {"total", sequence.frames.size()},   {"processed", counts.frames},
      {"tracked", counts.tracked},         {"tracked_percent", share(counts.tracked, counts.frames)},
      {"too_far", counts.too_far},         {"not_matched", counts.not_matched},
      {"relocalized", counts.relocalized}, {"elsewhere", counts.elsewhere},
      {"unreadable", result.unreadable}};
  json["stopped"] = result.stopped;
  json["median_inliers"] = counts.median_inliers;
  json["keyframes"] = result.map.keyframe_ids().size();
  json["start_map"] = result.start_keyframes == 0 ? nlohmann::ordered_json(nullptr)
                      : is_start_found(result)    ? nlohmann::ordered_json("recognised")
                                                  : nlohmann::ordered_json("not recognised");
  const LoopReport& loops = result.loops;
  json["loops"] = {{"tried", loops.tried},
                   {"verified", loops.verified},
                   {"rejected", loops.rejected},
                   {"unconfirmed", loops.unconfirmed},
                   {"joined", loops.joined},
                   {"closed", loops.closed},
                   {"parts_joined", loops.parts_joined}};
  json["landmarks"] = result.map.landmark_ids().size();
  json["graph_edges"] = result.graph_after.edges.size();
  json["ate_rmse_m"] = summary.ate_m ? nlohmann::ordered_json(*summary.ate_m) : nullptr;
  json["cloud_points"] = summary.cloud_points;
  json["octree"] = {{"occupied", summary.occupied_voxels}, {"free", summary.free_voxels}};
  json["seed"] = summary.seed;
  json["odometry"] = summary.odometry;
  json["threads"] = summary.threads;
  json["seconds"] = {{"total", summary.total_seconds}, {"fusion", summary.fusion_seconds}};
  for (const auto& [name, seconds] : stages(result.times))
    json["stages"][name] = to_json(summarize(*seconds));
  json["peak_memory_mb"] = peak_memory_mb();
  return json.dump(2) + "\n";
}

void print_summary(const Sequence& sequence, const SlamResult& result, const SlamSummary& summary,
                   const std::string& folder, const SlamOutputs& wanted) {
  const FrameCounts counts = count_frames(result);
  fmt::print("frames       {} of {} tracked ({:.1f} %), median {} inliers\n", counts.tracked, counts.frames,
             share(counts.tracked, counts.frames), counts.median_inliers);
  if (counts.tracked < counts.frames) {
    fmt::print("lost         {} not matched, {} too far, found again {} times\n", counts.not_matched,
               counts.too_far, counts.relocalized);
  }
  if (counts.elsewhere > 0)
    fmt::print("elsewhere    {} frames in a part of the map that was never joined with this one\n",
               counts.elsewhere);
  if (!result.unreadable.empty()) fmt::print("unreadable   {} frames, skipped\n", result.unreadable.size());
  if (result.stopped)
    fmt::print("stopped      after {} of {} frames; the outputs hold what was done\n", counts.frames,
               sequence.frames.size());
  if (result.start_keyframes > 0) print_start(result);
  fmt::print(
      "keyframes    {}{}\n", result.map.keyframe_ids().size(),
      result.start_keyframes > 0 ? fmt::format(", {} of this run", result.keyframe_trajectory().size()) : "");
  const LoopReport& loops = result.loops;
  fmt::print("landmarks    {}\n", result.map.landmark_ids().size());
  fmt::print("loops        {} closed, {} met without a gap, {} not believed, of {} keyframes compared\n",
             loops.closed, loops.joined, loops.rejected + loops.unconfirmed, loops.tried);
  if (loops.parts_joined > 0) fmt::print("parts        {} joined\n", loops.parts_joined);
  if (summary.ate_m) {
    fmt::print("accuracy     ATE RMSE {:.2f} cm against the sequence's truth (SE(3) alignment, {} pairs)\n",
               100 * *summary.ate_m, summary.ate_pairs);
  }
  fmt::print("picture      {}/{}, the map from above\n", folder, kMapPicture);
  if (wanted.cloud && summary.fused)
    fmt::print("cloud        {}/cloud.ply, {} points; a picture of it in cloud.png\n", folder,
               summary.cloud_points);
  if (wanted.octree && summary.fused)
    fmt::print("octree       {}/octree.ot, {} occupied and {} free voxels\n", folder, summary.occupied_voxels,
               summary.free_voxels);
  fmt::print("time         {:.1f} s on {} threads, {:.1f} frames/s\n", summary.total_seconds, summary.threads,
             static_cast<double>(counts.frames) / summary.total_seconds);
  fmt::print("  stages     total s, median ms, 95 % ms\n");
  for (const auto& [name, seconds] : stages(result.times)) {
    const TimeSummary time = summarize(*seconds);
    fmt::print("    {:<10} {:6.2f} {:8.2f} {:8.2f}\n", name, time.total, 1e3 * time.median,
               1e3 * time.percentile_95);
  }
  if (summary.fused) fmt::print("    {:<10} {:6.2f}\n", "fusion", summary.fusion_seconds);
  fmt::print("memory       {:.0f} MB at most\n", peak_memory_mb());
  fmt::print("written to   {}\n", folder);
  if (sequence.truth) fmt::print("next         cairn evaluate {} {}\n", folder, sequence.folder.string());
}

}  // namespace cairn::app
