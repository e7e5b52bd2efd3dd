// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/map/map_file.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/skipped_frames.h"
#include "commands.h"
#include "common.h"
#include "info_map.h"
#include "recording_checks.h"

namespace cairn::app {
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

void print_stereo(const Calibration& calibration) {
  if (!calibration.baseline) return;
  fmt::print("stereo       baseline {:.6g} m\n", *calibration.baseline);
  if (!calibration.raw_stereo) return;
  const auto& [pair, rectification] = *calibration.raw_stereo;
  fmt::print("raw left     {}\n", describe(pair.left));
  fmt::print("raw right    {}\n", describe(pair.right));
  fmt::print("             rectified on load, left turned by {:.2f} degrees, right by {:.2f}\n",
             angle_deg(rectification.rectified_from_left), angle_deg(rectification.rectified_from_right));
}

void print_association(const SequenceReport& report) {
  if (report.associated_by.empty() || report.color_images == 0) return;
  const bool is_stereo = report.right_images > 0;
  fmt::print("association  {} of {} {} images have a {} image ({:.1f} %), largest gap {:.1f} ms (by {})\n",
             report.associated, report.color_images, is_stereo ? "left" : "colour",
             is_stereo ? "right" : "depth",
             100.0 * static_cast<double>(report.associated) / static_cast<double>(report.color_images),
             1e3 * report.max_stamp_gap_s, report.associated_by);
}

void print_depth(const DepthCalibration& depth) {
  fmt::print("depth        {} units per metre, {}\n", depth.scale,
             depth.camera ? "own camera, registered to colour on load" : "registered to colour");
  if (depth.camera) fmt::print("             {}\n", describe(*depth.camera));
}

void print_text(const Sequence& sequence, std::int64_t unreadable) {
  fmt::print("sequence     {}\n", sequence.folder.string());
  fmt::print("format       {}\n", sequence.format);
  fmt::print("frames       {} over {:.2f} s, {:.2f} frames per second{}\n", sequence.frames.size(),
             duration_s(sequence), rate_hz(sequence),
             sequence.has_times ? "" : ": assumed, as nothing states times or rate_hz");
  if (unreadable > 0) fmt::print("unreadable   {} frames, which other commands skip\n", unreadable);
  print_association(sequence.report);
  fmt::print("camera       {}\n", describe(sequence.calibration.camera));
  fmt::print("             from {}\n", sequence.calibration_source);
  print_stereo(sequence.calibration);
  if (sequence.calibration.depth) print_depth(*sequence.calibration.depth);
  if (sequence.truth) {
    fmt::print("truth        {} poses, path {:.3f} m\n", sequence.truth->size(),
               path_length_m(*sequence.truth));
  } else {
    fmt::print("truth        none\n");
  }
  if (const auto oxts = oxts_in(sequence.folder))
    fmt::print("poses        OXTS packets in {}\n", oxts->string());
}

nlohmann::ordered_json to_json(const Camera& camera) {
  return {{"model", to_string(camera.model)},
          {"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", camera.distortion}};
}

nlohmann::ordered_json to_json(const RawStereo& raw) {
  const auto quaternion = [](const Eigen::Quaterniond& q) { return std::vector{q.x(), q.y(), q.z(), q.w()}; };
  const Rigid3& left_from_right = raw.pair.left_from_right;
  const Eigen::Vector3d& t = left_from_right.translation;
  return {
      {"left", to_json(raw.pair.left)},
      {"right", to_json(raw.pair.right)},
      {"left_from_right",
       {{"translation", {t.x(), t.y(), t.z()}}, {"quaternion_xyzw", quaternion(left_from_right.rotation)}}},
      {"rectified_from_left_xyzw", quaternion(raw.rectification.rectified_from_left)},
      {"rectified_from_right_xyzw", quaternion(raw.rectification.rectified_from_right)}};
}

void print_json(const Sequence& sequence, std::int64_t unreadable) {
  nlohmann::ordered_json json;
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
  json["depth_scale"] =
      sequence.calibration.depth ? nlohmann::ordered_json(sequence.calibration.depth->scale) : nullptr;
  json["baseline_m"] =
      sequence.calibration.baseline ? nlohmann::ordered_json(*sequence.calibration.baseline) : nullptr;
  json["raw_stereo"] = sequence.calibration.raw_stereo ? to_json(*sequence.calibration.raw_stereo) : nullptr;
  json["truth_poses"] = sequence.truth ? sequence.truth->size() : 0;
  json["truth_path_m"] = sequence.truth ? path_length_m(*sequence.truth) : 0.0;
  const auto oxts = oxts_in(sequence.folder);
  json["oxts"] = oxts ? nlohmann::ordered_json(oxts->string()) : nullptr;
  fmt::print("{}\n", json.dump(2));
}

/// Looks at all images, and decodes those of one frame. InputError where no frame can be read.
std::int64_t count_unreadable(const Sequence& sequence, Progress& progress) {
  const FrameLoader loader(sequence);
  SkippedFrames skipped(progress);
  bool any_decoded = false;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const FrameId id{static_cast<std::int32_t>(i)};
    try {
      loader.probe(id);
      if (!any_decoded) (void)loader.load(id);
      any_decoded = true;
      skipped.take();
    } catch (const InputError&) {
      skipped.skip(std::current_exception());
    }
  }
  skipped.finish();
  return skipped.count();
}

/// What chooses from a sequence would do nothing for a map.
void require_no_choice(const CommandLine& app) {
  for (const char* option : {"--camera", "--frames", "--without"}) {
    if (app.count(option) > 0)
      throw InputError({option, 0, "a sequence to apply it to", "a map", "Leave the option out."});
  }
}

}  // namespace

int run_info(int argc, char** argv) {
  CommandLine app("What a sequence or a map is: format, frames, cameras, truth; keyframes, landmarks.",
                  "info");
  CommonOptions common;
  SequenceArguments arguments;
  app.add_option("SEQ", arguments.folder, "folder with a sequence, a map, or a run with its map").required();
  add_sequence_options(app, arguments);
  add_common_options(app, common, {.quiet = false});
  app.footer("Example: cairn info demo/room");
  if (const auto code = app.parse(argc, argv)) return *code;
  if (const auto map = find_map_folder(arguments.folder)) {
    require_no_choice(app);
    print_map_info(*map, common.json);
    return 0;
  }
  const Sequence sequence = open_sequence(arguments.folder, arguments.options());
  print_warnings(sequence.report.warnings);
  const auto progress = make_progress(common);
  const std::int64_t unreadable = count_unreadable(sequence, *progress);
  check_recording(sequence, *progress);
  common.json ? print_json(sequence, unreadable) : print_text(sequence, unreadable);
  return 0;
}

}  // namespace cairn::app
