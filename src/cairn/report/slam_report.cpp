// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/slam_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cairn/core/text.h"
#include "cairn/report/depth_noise.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/keyframe_report.h"
#include "cairn/report/ratio.h"
#include "cairn/report/slam_figures.h"
#include "cairn/report/stereo_calibration.h"

namespace cairn {
namespace {

Json to_json(const TimeSummary& time) {
  return {{"total_s", time.total},
          {"median_ms", 1e3 * time.median},
          {"percentile_95_ms", 1e3 * time.percentile_95}};
}

Json frames_json(const Sequence& sequence, const SlamResult& result, const FrameCounts& counts) {
  return {
      {"total", sequence.frames.size()},   {"processed", counts.frames},
      {"tracked", counts.tracked},         {"tracked_percent", share_percent(counts.tracked, counts.frames)},
      {"too_far", counts.too_far},         {"not_matched", counts.not_matched},
      {"relocalized", counts.relocalized}, {"elsewhere", counts.elsewhere},
      {"unreadable", result.unreadable}};
}

Json precision_json(const SlamResult& result) {
  const auto last = last_keyframe_precision(result);
  if (!last) return nullptr;
  return {{"position_m", last->position_m}, {"rotation_deg", last->rotation_deg}};
}

Json start_json(const SlamResult& result) {
  if (result.start_keyframes == 0) return nullptr;
  return is_start_found(result) ? "recognised" : "not recognised";
}

Json loops_json(const LoopReport& loops) {
  return {{"tried", loops.tried},
          {"verified", loops.verified},
          {"rejected", loops.rejected},
          {"unconfirmed", loops.unconfirmed},
          {"joined", loops.joined},
          {"closed", loops.closed},
          {"parts_joined", loops.components_joined}};
}

Rigid3 world_from_frame(const Map& map, const TrackingResult& track) {
  return map.world_from_camera(*track.reference) * track.reference_from_frame;
}

/// The motion since the last tracked frame, and its size since that frame's keyframe; empty without one in
/// the same component.
std::string motion_columns(const Map& map, const TrackingResult* last, const TrackingResult& track) {
  if (last == nullptr || !track.tracked() ||
      map.component_of(*last->reference) != map.component_of(*track.reference))
    return ",,,";
  const Rigid3 pose = world_from_frame(map, track);
  const Rigid3 motion = world_from_frame(map, *last).inverse() * pose;
  const Rigid3 since_keyframe = map.world_from_camera(*last->reference).inverse() * pose;
  return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", rotation_angle(motion.rotation),
                     motion.translation.norm(), motion_norm(motion), motion_norm(since_keyframe));
}

}  // namespace

std::string format_slam_json(const Sequence& sequence, const SlamResult& result, const SlamSummary& summary) {
  const FrameCounts counts = count_frames(result);
  Json json;
  json["cairn"] = CAIRN_VERSION;
  json["sequence"] = sequence.folder.string();
  json["frames"] = frames_json(sequence, result, counts);
  json["stopped"] = result.stopped;
  json["median_inliers"] = counts.median_inliers;
  json["keyframes"] = result.map.keyframe_ids().size();
  json["start_map"] = start_json(result);
  json["loops"] = loops_json(result.loops);
  json["landmarks"] = result.map.landmark_ids().size();
  json["stereo_calibration"] =
      to_json(StereoCalibrationFigures{result.row_errors, result.rows_aligned, result.disparity_calibration});
  json["depth_noise"] = to_json(result.depth_noise);
  json["last_keyframe_precision"] = precision_json(result);
  json["graph_edges"] = result.graph_after.edges.size();
  json["ate_rmse_m"] = json_of(summary.ate_m);
  json["cloud_points"] = summary.cloud_points;
  json["octree"] = {{"occupied", summary.occupied_voxels}, {"free", summary.free_voxels}};
  json["seed"] = summary.seed;
  json["odometry"] = summary.odometry;
  json["threads"] = summary.threads;
  json["seconds"] = {{"total", summary.total_seconds}, {"fusion", summary.fusion_seconds}};
  for (const auto& [name, seconds] : stages(result.times))
    json["stages"][name] = to_json(summarize(*seconds));
  json["peak_memory_mb"] = summary.peak_memory_mb;
  return format_document(json);
}

std::string format_frames_csv(const SlamResult& result) {
  std::string text =
      "frame,stamp_s,outcome,relocalized,part,reference_keyframe,matches,inliers,rotation_rad,translation_m,"
      "motion,motion_since_keyframe\n";
  const TrackingResult* last = nullptr;
  for (const TrackingResult& track : result.frames) {
    const std::string component =
        track.reference ? fmt::format("{}", result.map.component_of(*track.reference)) : "";
    const std::string reference = track.reference ? fmt::format("{}", track.reference->value) : "";
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", track.frame.value, format_stamp(track.stamp_ns),
                        to_string(track.status), track.relocalized ? 1 : 0, component, reference,
                        track.matches, track.inliers, motion_columns(result.map, last, track));
    if (track.tracked()) last = &track;
  }
  return text;
}

CameraPath main_path(const SlamResult& result) {
  CameraPath path;
  const std::int32_t component = result.main_component();
  for (const TrackingResult& track : result.frames) {
    if (!track.tracked() || result.map.component_of(*track.reference) != component) continue;
    const Keyframe& reference = result.map[*track.reference];
    const bool is_keyframe = track.frame == reference.observed.frame && !reference.erased;
    if (is_keyframe) path.keyframes.push_back(path.world_from_camera.size());
    path.world_from_camera.push_back(result.map.world_from_camera(reference.id) * track.reference_from_frame);
  }
  return path;
}

}  // namespace cairn
