// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "common.h"

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
  return fmt::format("{} {}x{}, fx {} fy {} cx {} cy {} px", to_string(camera.model), camera.width,
                     camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
}

void print_depth(const DepthCalibration& depth) {
  fmt::print("depth        {} units per metre, {}\n", depth.scale,
             depth.camera ? "own camera, registered to colour on load" : "registered to colour");
  if (depth.camera) fmt::print("             {}\n", describe(*depth.camera));
}

void print_text(const Sequence& sequence) {
  const SequenceReport& report = sequence.report;
  fmt::print("sequence     {}\n", sequence.folder.string());
  fmt::print("format       {}\n", sequence.format);
  fmt::print("frames       {} over {:.2f} s, {:.2f} frames per second\n", sequence.frames.size(),
             duration_s(sequence), rate_hz(sequence));
  if (report.depth_images > 0 && !report.associated_by.empty()) {
    fmt::print("association  {} of {} colour images have a depth image ({:.1f} %), largest gap {:.1f} ms{}\n",
               report.associated, report.color_images,
               100.0 * static_cast<double>(report.associated) / static_cast<double>(report.color_images),
               1e3 * report.max_stamp_gap_s,
               report.associated_by.empty() ? "" : fmt::format(" (by {})", report.associated_by));
  }
  fmt::print("camera       {}\n", describe(sequence.calibration.camera));
  fmt::print("             from {}\n", sequence.calibration_source);
  if (sequence.calibration.baseline)
    fmt::print("stereo       baseline {:.6g} m\n", *sequence.calibration.baseline);
  if (sequence.calibration.depth) print_depth(*sequence.calibration.depth);
  if (sequence.truth) {
    fmt::print("truth        {} poses, path {:.3f} m\n", sequence.truth->size(),
               path_length_m(*sequence.truth));
  } else {
    fmt::print("truth        none\n");
  }
}

void print_json(const Sequence& sequence) {
  const Camera& camera = sequence.calibration.camera;
  nlohmann::ordered_json json;
  json["sequence"] = sequence.folder.string();
  json["format"] = sequence.format;
  json["frames"] = sequence.frames.size();
  json["duration_s"] = duration_s(sequence);
  json["rate_hz"] = rate_hz(sequence);
  json["color_images"] = sequence.report.color_images;
  json["depth_images"] = sequence.report.depth_images;
  json["associated"] = sequence.report.associated;
  json["max_stamp_gap_s"] = sequence.report.max_stamp_gap_s;
  json["camera"] = {{"model", to_string(camera.model)},
                    {"width", camera.width},
                    {"height", camera.height},
                    {"fx", camera.fx},
                    {"fy", camera.fy},
                    {"cx", camera.cx},
                    {"cy", camera.cy},
                    {"distortion", camera.distortion}};
  json["depth_scale"] =
      sequence.calibration.depth ? nlohmann::ordered_json(sequence.calibration.depth->scale) : nullptr;
  json["baseline_m"] =
      sequence.calibration.baseline ? nlohmann::ordered_json(*sequence.calibration.baseline) : nullptr;
  json["truth_poses"] = sequence.truth ? sequence.truth->size() : 0;
  json["truth_path_m"] = sequence.truth ? path_length_m(*sequence.truth) : 0.0;
  fmt::print("{}\n", json.dump(2));
}

}  // namespace

int run_info(int argc, char** argv) {
  CLI::App app("What a sequence is: format, frames, cameras, truth.\n\nexample: cairn info demo/room",
               "info");
  CommonOptions common;
  SequenceArguments arguments;
  app.add_option("SEQ", arguments.folder, "folder with a sequence")->required();
  add_sequence_options(app, arguments);
  add_common_options(app, common, {.quiet = false});
  if (const auto code = parse(app, argc, argv)) return *code;
  const Sequence sequence = open_sequence(arguments.folder, arguments.options());
  common.json ? print_json(sequence) : print_text(sequence);
  (void)FrameLoader(sequence).load({0});  // throws where the images do not fit the calibration
  return 0;
}

}  // namespace cairn::app
