// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cairn/report/depth_noise.h"
#include "cairn/report/keyframe_report.h"
#include "cairn/report/landmark_picture.h"
#include "cairn/report/ratio.h"
#include "cairn/report/slam_figures.h"
#include "cairn/report/slam_report.h"
#include "cairn/report/stereo_calibration.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

void add_frames(const Sequence& sequence, const SlamResult& result, const FrameCounts& counts,
                TextBuilder& text) {
  text.add("frames       {} of {} tracked ({:.1f} %), median {} inliers\n", counts.tracked, counts.frames,
           share_percent(counts.tracked, counts.frames), counts.median_inliers);
  if (counts.tracked < counts.frames) {
    text.add("lost         {} not matched, {} too far, found again {} times\n", counts.not_matched,
             counts.too_far, counts.relocalized);
  }
  if (counts.elsewhere > 0)
    text.add("elsewhere    {} frames in a part of the map that was never joined with this one\n",
             counts.elsewhere);
  if (!result.unreadable.empty()) text.add("unreadable   {} frames, skipped\n", result.unreadable.size());
  if (result.stopped)
    text.add("stopped      after {} of {} frames; the outputs hold what was done\n", counts.frames,
             sequence.frames.size());
}

void add_start(const SlamResult& result, TextBuilder& text) {
  if (result.start_keyframes == 0) return;
  if (!is_start_found(result)) {
    text.add("start map    not recognised: the trajectory is in a world of its own, a new part of the map\n");
    return;
  }
  const std::int32_t component = result.main_component();
  const auto in_main = [&](const TrackingResult& track) {
    return track.tracked() && result.map.component_of(*track.reference) == component;
  };
  const auto first = std::find_if(result.frames.begin(), result.frames.end(), in_main);
  text.add("start map    recognised; the trajectory is in its world, from frame {} on\n", first->frame.value);
}

void add_map(const SlamResult& result, TextBuilder& text) {
  text.add(
      "keyframes    {}{}\n", result.map.keyframe_ids().size(),
      result.start_keyframes > 0 ? fmt::format(", {} of this run", result.keyframe_trajectory().size()) : "");
  const LoopReport& loops = result.loops;
  text.add("landmarks    {}\n", result.map.landmark_ids().size());
  text.add("loops        {} closed, {} met without a gap, {} not believed, of {} keyframes compared\n",
           loops.closed, loops.joined, loops.rejected + loops.unconfirmed, loops.tried);
  const std::string pair = describe({result.row_errors, result.rows_aligned, result.disparity_calibration});
  if (!pair.empty()) text.add("{}\n", pair);
  if (const std::string depth = describe(result.depth_noise); !depth.empty()) text.add("{}\n", depth);
  if (loops.components_joined > 0) text.add("components   {} joined\n", loops.components_joined);
  if (const auto last = last_keyframe_precision(result))
    text.add(
        "precision    last keyframe to {:.2g} m and {:.2g} degrees of the first (one standard deviation)\n",
        last->position_m, last->rotation_deg);
}

void add_files(const SlamSummary& summary, TextBuilder& text) {
  if (summary.ate_m) {
    text.add("accuracy     ATE RMSE {:.2f} cm against the sequence's truth (SE(3) alignment, {} pairs)\n",
             100 * *summary.ate_m, summary.ate_pairs);
  }
  text.add("picture      {}/{}, the map from above\n", summary.folder, kLandmarkPicture);
  if (summary.has_cloud)
    text.add("cloud        {}/cloud.ply, {} points; a picture of it in cloud.png\n", summary.folder,
             summary.cloud_points);
  if (summary.has_octree)
    text.add("octree       {}/octree.ot, {} occupied and {} free voxels\n", summary.folder,
             summary.occupied_voxels, summary.free_voxels);
}

void add_times(const SlamResult& result, const SlamSummary& summary, TextBuilder& text) {
  text.add("time         {:.1f} s on {} threads, {:.1f} frames/s\n", summary.total_seconds, summary.threads,
           static_cast<double>(result.frames.size()) / summary.total_seconds);
  text.add("  stages     total s, median ms, 95 % ms\n");
  for (const auto& [name, seconds] : stages(result.times)) {
    const TimeSummary time = summarize(*seconds);
    text.add("    {:<10} {:6.2f} {:8.2f} {:8.2f}\n", name, time.total, 1e3 * time.median,
             1e3 * time.percentile_95);
  }
  if (summary.fused) text.add("    {:<10} {:6.2f}\n", "fusion", summary.fusion_seconds);
  text.add("memory       {:.0f} MB at most\n", summary.peak_memory_mb);
}

}  // namespace

std::string format_slam_text(const Sequence& sequence, const SlamResult& result, const SlamSummary& summary) {
  TextBuilder text;
  add_frames(sequence, result, count_frames(result), text);
  add_start(result, text);
  add_map(result, text);
  add_files(summary, text);
  add_times(result, summary, text);
  text.add("written to   {}\n", summary.folder);
  if (sequence.truth)
    text.add("next         cairn evaluate {} {}\n", summary.folder, sequence.folder.string());
  return text.take();
}

}  // namespace cairn
