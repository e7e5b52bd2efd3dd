// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/sequence_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "cairn/report/json_pieces.h"
#include "cairn/report/ratio.h"
#include "cairn/report/text_builder.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {
namespace {

double seconds(std::int64_t ns) {
  return 1e-9 * static_cast<double>(ns);
}

double duration_s(const Sequence& sequence) {
  return seconds(sequence.frames.back().stamp_ns - sequence.frames.front().stamp_ns);
}

double rate_hz(const Sequence& sequence) {
  const double duration = duration_s(sequence);
  return duration > 0 ? static_cast<double>(sequence.frames.size() - 1) / duration : 0;
}

double path_length_m(const Trajectory& trajectory) {
  double length = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].world_from_camera.translation - trajectory[i - 1].world_from_camera.translation)
                  .norm();
  }
  return length;
}

std::string describe(const Camera& camera) {
  return fmt::format("{} {}x{}, fx {:.7g} fy {:.7g} cx {:.7g} cy {:.7g} px", to_string(camera.model),
                     camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
}

double angle_deg(const Eigen::Quaterniond& rotation) {
  return rotation_angle(rotation) * 180.0 / std::numbers::pi;
}

Json to_json(const std::optional<StereoCorrection>& correction) {
  if (!correction) return nullptr;
  return {{"rows_px", std::vector<double>(correction->rows.begin(), correction->rows.end())},
          {"disparity_px", std::vector<double>(correction->disparity.begin(), correction->disparity.end())}};
}

void add_stereo(const Calibration& calibration, TextBuilder& text) {
  if (!calibration.baseline) return;
  text.add("stereo       baseline {:.6g} m{}\n", *calibration.baseline,
           calibration.right_correction ? ", right images corrected" : "");
  if (!calibration.raw_stereo) return;
  const auto& [pair, rectification] = *calibration.raw_stereo;
  text.add("raw left     {}\n", describe(pair.left));
  text.add("raw right    {}\n", describe(pair.right));
  text.add("             rectified on load, left turned by {:.2f} degrees, right by {:.2f}\n",
           angle_deg(rectification.rectified_from_left), angle_deg(rectification.rectified_from_right));
}

void add_association(const SequenceReport& report, TextBuilder& text) {
  if (report.associated_by.empty() || report.color_images == 0) return;
  const bool is_stereo = report.right_images > 0;
  text.add("association  {} of {} {} images have a {} image ({:.1f} %), largest gap {:.1f} ms (by {})\n",
           report.associated, report.color_images, is_stereo ? "left" : "colour",
           is_stereo ? "right" : "depth", share_percent(report.associated, report.color_images),
           1e3 * report.max_stamp_gap_s, report.associated_by);
}

void add_depth(const DepthCalibration& depth, TextBuilder& text) {
  text.add("depth        {} units per metre, {}\n", depth.scale,
           depth.camera ? "own camera, registered to colour on load" : "registered to colour");
  if (depth.camera) text.add("             {}\n", describe(*depth.camera));
}

Json to_json(const Camera& camera) {
  return {{"model", to_string(camera.model)},
          {"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

Json to_json(const RawStereo& raw) {
  const Rigid3& left_from_right = raw.pair.left_from_right;
  return {{"left", to_json(raw.pair.left)},
          {"right", to_json(raw.pair.right)},
          {"left_from_right",
           {{"translation", json_of(left_from_right.translation)},
            {"quaternion_xyzw", json_of(left_from_right.rotation)}}},
          {"rectified_from_left_xyzw", json_of(raw.rectification.rectified_from_left)},
          {"rectified_from_right_xyzw", json_of(raw.rectification.rectified_from_right)}};
}

}  // namespace

std::string format_sequence_text(const Sequence& sequence, std::int64_t unreadable) {
  TextBuilder text;
  text.add("sequence     {}\n", sequence.folder.string());
  text.add("format       {}\n", sequence.format);
  text.add("frames       {} over {:.2f} s, {:.2f} frames per second{}\n", sequence.frames.size(),
           duration_s(sequence), rate_hz(sequence),
           sequence.has_times ? "" : ": assumed, as nothing states times or rate_hz");
  if (unreadable > 0) text.add("unreadable   {} frames, which other commands skip\n", unreadable);
  add_association(sequence.report, text);
  text.add("camera       {}\n", describe(sequence.calibration.camera));
  text.add("             from {}\n", sequence.calibration_source);
  add_stereo(sequence.calibration, text);
  if (sequence.calibration.depth) add_depth(*sequence.calibration.depth, text);
  if (sequence.truth) {
    text.add("truth        {} poses, path {:.3f} m\n", sequence.truth->size(),
             path_length_m(*sequence.truth));
  } else {
    text.add("truth        none\n");
  }
  if (const auto oxts = oxts_in(sequence.folder))
    text.add("poses        OXTS packets in {}\n", oxts->string());
  return text.take();
}

std::string format_sequence_json(const Sequence& sequence, std::int64_t unreadable) {
  Json json;
  json["sequence"] = sequence.folder.string();
  json["format"] = sequence.format;
  json["frames"] = sequence.frames.size();
  json["unreadable"] = unreadable;
  json["duration_s"] = duration_s(sequence);
  json["rate_hz"] = rate_hz(sequence);
  json["has_times"] = sequence.has_times;
  json["color_images"] = sequence.report.color_images;
  json["depth_images"] = sequence.report.depth_images;
  json["right_images"] = sequence.report.right_images;
  json["associated"] = sequence.report.associated;
  json["max_stamp_gap_s"] = sequence.report.max_stamp_gap_s;
  json["camera"] = to_json(sequence.calibration.camera);
  json["depth_scale"] = sequence.calibration.depth ? Json(sequence.calibration.depth->scale) : Json();
  json["baseline_m"] = sequence.calibration.baseline ? Json(*sequence.calibration.baseline) : nullptr;
  json["right_correction"] = to_json(sequence.calibration.right_correction);
  json["raw_stereo"] = sequence.calibration.raw_stereo ? to_json(*sequence.calibration.raw_stereo) : nullptr;
  json["truth_poses"] = sequence.truth ? sequence.truth->size() : 0;
  json["truth_path_m"] = sequence.truth ? path_length_m(*sequence.truth) : 0.0;
  const auto oxts = oxts_in(sequence.folder);
  json["oxts"] = oxts ? Json(oxts->string()) : nullptr;
  return format_document(json);
}

}  // namespace cairn
