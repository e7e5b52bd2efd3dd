// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/survey_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cairn/report/depth_noise.h"
#include "cairn/report/json_pieces.h"
#include "cairn/report/landmark_picture.h"
#include "cairn/report/ratio.h"
#include "cairn/report/stereo_calibration.h"
#include "cairn/report/text_builder.h"

namespace cairn {
namespace {

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json to_json(const PoseCheck& check) {
  return {{"verdict", to_string(check.verdict)},
          {"pairs", check.pairs},
          {"rotation_by_images_deg", check.image_rotation_deg},
          {"rotation_by_poses_deg", check.pose_rotation_deg},
          {"motion_by_images_m", check.image_motion_m},
          {"motion_by_poses_m", check.pose_motion_m},
          {"motion_in_image_px", check.flow_px},
          {"error_px", finite_or_null(check.error_px)}};
}

/// Holds the root mean squares by which held-out frames were missed: position (metres), rotation (degrees).
struct HeldOutFigures {
  std::size_t frames = 0;
  double to_map_m = 0, to_map_deg = 0, to_given_m = 0, to_given_deg = 0;
};

HeldOutFigures held_out_figures(const std::vector<HeldOutFrame>& frames) {
  Vector6d to_map = Vector6d::Zero(), to_given = Vector6d::Zero();
  for (const HeldOutFrame& frame : frames) {
    to_map += frame.to_map.cwiseAbs2();
    to_given += frame.to_given.cwiseAbs2();
  }
  const double count = std::max(1.0, static_cast<double>(frames.size()));
  const auto rms = [&](const auto& squares) { return std::sqrt(squares.sum() / count); };
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {frames.size(), rms(to_map.tail<3>()), kDegrees * rms(to_map.head<3>()), rms(to_given.tail<3>()),
          kDegrees * rms(to_given.head<3>())};
}

Json to_json(const VariancePrior& prior, const LandmarkNoise& noise) {
  return {{"variance_factor", prior.scale},
          {"degrees_of_freedom", prior.freedom},
          {"disparities", {{"constant", noise.disparities[0]}, {"by_landmark", noise.disparities[1]}}},
          {"pixels",
           {{"constant", noise.pixels[0]},
            {"by_observation", noise.pixels[1]},
            {"by_parallax", noise.pixels[2]}}}};
}

Json to_json(const HeldOutFigures& figures) {
  return {{"frames", figures.frames},
          {"to_map_rms_m", figures.to_map_m},
          {"to_map_rms_deg", figures.to_map_deg},
          {"to_given_rms_m", figures.to_given_m},
          {"to_given_rms_deg", figures.to_given_deg}};
}

/// Returns a line, or nothing if no frame was held out.
std::string describe(const HeldOutFigures& figures) {
  if (figures.frames == 0) return {};
  return fmt::format(
      "held out     {} frames, located without their own observations: {:.2g} cm and {:.2g} degrees from\n"
      "             their poses in the map, {:.2g} cm and {:.2g} degrees from the given ones (RMS)\n",
      figures.frames, 100 * figures.to_map_m, figures.to_map_deg, 100 * figures.to_given_m,
      figures.to_given_deg);
}

Json to_json(const MovesInSigmas& moves) {
  if (moves.frames == 0) return {{"moved_sigmas", Json()}, {"turned_sigmas", Json()}};
  const auto both = [&](double MoveInSigmas::*part) {
    return Json{{"median", finite_or_null(moves.median.*part)}, {"max", finite_or_null(moves.largest.*part)}};
  };
  return {{"moved_sigmas", both(&MoveInSigmas::position)}, {"turned_sigmas", both(&MoveInSigmas::rotation)}};
}

/// Returns the end of a line, or nothing if no pose that states deviations was moved.
std::string describe(const MovesInSigmas& moves) {
  std::vector<std::string> parts;
  const auto add = [&](const char* verb, double median, double largest) {
    if (largest > 0) parts.push_back(fmt::format("{} by {:.2g} ({:.2g} at most)", verb, median, largest));
  };
  add("moved", moves.median.position, moves.largest.position);
  add("turned", moves.median.rotation, moves.largest.rotation);
  if (parts.empty()) return {};
  return fmt::format(":\n             in standard deviations that they state {} (medians)",
                     fmt::join(parts, ", "));
}

Json to_json(const SurveyResult& result) {
  const SurveyCounts& counts = result.counts;
  Json json;
  json["frames"] = {{"mapped", counts.frames},
                    {"without_pose", counts.without_pose},
                    {"standing", counts.stationary},
                    {"unreadable", counts.unreadable}};
  json["features"] = {
      {"found", counts.features}, {"with_depth", counts.measured}, {"matched_to_tracks", counts.matched}};
  json["tracks"] = {
      {"finished", counts.tracks}, {"too_short", counts.too_short}, {"contradictory", counts.inconsistent}};
  for (std::size_t i = 0; i < kCleaningRules; ++i)
    json["cleaned"][std::string(to_string(static_cast<CleaningRule>(i)))] = counts.cleaned[i];
  json["merged"] = counts.merged;
  json["landmarks"] = counts.landmarks;
  json["sightings"] = counts.observations;
  json["dropped_sightings"] = counts.dropped_observations;
  for (std::size_t i = 0; i < kBeyondPx.size(); ++i)
    json["share_beyond_px"][fmt::format("{}", kBeyondPx[i])] = ratio(counts.beyond[i], counts.observations);
  json["noise"] = to_json(result.noise, result.landmark_noise);
  json["held_out"] = to_json(held_out_figures(result.held_out));
  json["smoothed_poses"] = {{"moved_rms_m", result.moved_rms_m}, {"turned_rms_deg", result.turned_rms_deg}};
  json["smoothed_poses"].update(to_json(result.moves));
  json["uncertainty"] = {{"by_images_rms_m", result.image_std_rms_m},
                         {"by_poses_rms_m", result.pose_std_rms_m},
                         {"dominated_by_poses", counts.dominated_by_poses},
                         {"stated_position_std_m", result.stated.position_m},
                         {"stated_rotation_std_deg", result.stated.rotation_deg}};
  json["depth_noise"] = to_json(result.depth_noise);
  json["stereo_calibration"] =
      to_json(StereoCalibrationFigures{result.row_errors, result.rows_aligned, result.disparity_calibration});
  json["pose_check"] = to_json(result.pose_check);
  return json;
}

/// Returns how many landmarks fell to which rule, in the order of the rules; leaves out those to which none
/// fell.
std::string describe_cleaning(const SurveyCounts& counts) {
  constexpr std::array<const char*, kCleaningRules> kWords = {
      "seen in too few frames", "too uncertain", "residuals too large", "rays too parallel",
      "depth out of range",     "too far away",  "too far aside",       "seen too obliquely"};
  std::string text;
  for (std::size_t i = 0; i < kCleaningRules; ++i) {
    if (counts.cleaned[i] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts.cleaned[i], kWords[i]);
  }
  return text.empty() ? "none fell to a rule" : text;
}

void add_frames(const SurveyCounts& counts, const SurveySummary& summary, TextBuilder& text) {
  text.add("frames       {} of {} mapped", counts.frames, summary.sequence_frames);
  if (counts.without_pose > 0) text.add(", {} without pose", counts.without_pose);
  if (counts.stationary > 0) text.add(", {} without motion", counts.stationary);
  if (counts.unreadable > 0) text.add(", {} unreadable", counts.unreadable);
  text.add("\n");
}

}  // namespace

std::string format_survey_report(const SurveyResult& result) {
  return format_document(to_json(result));
}

std::string format_survey_json(const SurveyResult& result, const SurveySummary& summary) {
  Json json;
  json["cairn"] = CAIRN_VERSION;
  json["map"] = summary.folder;
  json["poses"] = summary.poses_format;
  json["stopped"] = result.stopped;
  json["resumed_at"] = result.resumed_at;
  json.update(to_json(result));
  const SurveyTimes& times = result.times;
  json["threads"] = summary.threads;
  json["seconds"] = {{"total", summary.total_seconds}, {"decode", times.decode},
                     {"features", times.features},     {"matching", times.matching},
                     {"poses", times.poses},           {"adjustment", times.adjustment},
                     {"merging", times.merging},       {"writing", times.writing}};
  json["peak_memory_mb"] = summary.peak_memory_mb;
  return format_document(json);
}

std::string format_survey_text(const SurveyResult& result, const SurveySummary& summary) {
  const SurveyCounts& counts = result.counts;
  TextBuilder text;
  add_frames(counts, summary, text);
  if (result.resumed_at > 0) text.add("resumed      at frame {} of the sequence\n", result.resumed_at);
  text.add("poses        {}", summary.poses_format);
  if (result.moved_rms_m > 0)
    text.add(", moved by {:.1f} cm and {:.3f} degrees (RMS) to agree with the images",
             100 * result.moved_rms_m, result.turned_rms_deg);
  text.add("{}", describe(result.moves));
  if (result.pose_check.verdict == PoseVerdict::contradiction)
    text.add("\n             they contradict the images: {}", describe(result.pose_check));
  const std::string pair = describe(
      StereoCalibrationFigures{result.row_errors, result.rows_aligned, result.disparity_calibration});
  if (!pair.empty()) text.add("\n{}", pair);
  if (const std::string depth = describe(result.depth_noise); !depth.empty()) text.add("\n{}", depth);
  text.add("\nfeatures     {:.0f} a frame, {:.0f} with depth, {:.0f} matched to a track\n",
           ratio(counts.features, counts.frames), ratio(counts.measured, counts.frames),
           ratio(counts.matched, counts.frames));
  text.add("tracks       {}, {} in too few frames, {} contradict themselves\n", counts.tracks,
           counts.too_short, counts.inconsistent);
  text.add("cleaning     {}; {} merged\n", describe_cleaning(counts), counts.merged);
  text.add("landmarks    {}, in {:.1f} frames each\n", counts.landmarks,
           ratio(counts.observations, counts.landmarks));
  text.add("{}", describe(held_out_figures(result.held_out)));
  const std::string by_poses = result.pose_std_rms_m > 0
                                   ? fmt::format("{:.2g} m by the poses'", result.pose_std_rms_m)
                               : result.moves.frames > 0 ? "those of the poses not counted"
                                                         : "none stated of the poses";
  text.add("deviations   {:.2g} m by what the images leave open, {} (RMS, worst direction)\n",
           result.image_std_rms_m, by_poses);
  text.add("map          {}; cairn info {} says how good it is\n", summary.folder, summary.folder);
  text.add("picture      {}/{}, the landmarks from above\n", summary.folder, kLandmarkPicture);
  if (!summary.image_root.empty())
    text.add("colmap       {}/colmap, with --image_path {}\n", summary.folder, summary.image_root);
  text.add("time         {:.1f} s, {:.0f} ms a frame\n", summary.total_seconds,
           1000 * summary.total_seconds / std::max(1.0, static_cast<double>(counts.frames)));
  text.add("memory       {:.0f} MB at most\n", summary.peak_memory_mb);
  return text.take();
}

}  // namespace cairn
