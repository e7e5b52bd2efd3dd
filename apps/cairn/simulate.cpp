// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/report/recording_report.h"
#include "cairn/simulate/write_kitti.h"
#include "cairn/simulate/write_tum.h"
#include "commands.h"
#include "common.h"

namespace cairn::app {
namespace {

struct Arguments {
  CommonOptions common;
  std::string output;
  std::string noise;
  double scale = 1;  ///< of the image size
  bool depth_truth = false;
  std::array<double, 3> right_rotation_deg{};
  bool body_poses = false;
  double pose_time_offset_s = 0;
  std::array<double, 3> lever_arm_error{}, boresight_error_deg{};
  std::string route = "block";
  std::array<double, 2> pose_error{}, pose_jitter{};  ///< metres, degrees
};

/// What every simulated sequence has, with `Options` for its own defaults.
template <class Options>
void add_shared_options(CommandLine& app, Options& options, Arguments& arguments) {
  app.add_option("-o,--output", arguments.output, "folder to write; a folder that cairn wrote is replaced")
      .required()
      .type_name("DIR");
  app.add_option("--frames-count,--frames", options.frames_count,
                 fmt::format("frames, at {} a second", options.rate_hz))
      .show_default()
      .type_name("N");
  app.add_option("--speed", options.speed, "metres a second").show_default().type_name("V");
  app.add_option("--loops", options.loops, "times around; 0: as many as the way needs, or a part of one")
      .show_default()
      .type_name("N");
  app.add_option("--scale", arguments.scale, "image width and height over the default's")
      .check(number_in(0.05, 4))
      .show_default()
      .type_name("X");
  add_common_options(app, arguments.common, {.threads = true, .seed = true});
}

void add_noise_option(CommandLine& app, const std::string& sensor, const std::string& description,
                      Arguments& arguments) {
  app.add_option("--noise", arguments.noise,
                 fmt::format("{}; none: exact (default: {})", description, sensor))
      .check(one_of({sensor, std::string("none")}))
      .type_name("NAME");
}

/// Adds the errors of the right camera that the written calibration does not know.
void add_planted_errors(CommandLine& street, SimulateStreetOptions& options, Arguments& arguments) {
  street
      .add_option(
          "--right-rotation", arguments.right_rotation_deg,
          "degrees, -5 to 5, by which the right camera is turned, unknown to the calibration: rotation "
          "vector about its x (above 0: up), y (to the right) and z (clockwise) (default: 0 0 0)")
      .check(number_in(-5, 5))
      .type_name("RX RY RZ");
  street
      .add_option("--baseline-error", options.baseline_error_percent,
                  "percent, -20 to 20, by which the true baseline is longer than the stated --baseline")
      .check(number_in(-20, 20))
      .show_default()
      .type_name("PERCENT");
}

/// Adds the poses of the car's body and their errors, which what is written states nothing of.
void add_body_poses(CommandLine& street, Arguments& arguments) {
  constexpr double kMost = 10;
  street.add_flag("--body-poses", arguments.body_poses,
                  "also body_poses.csv, poses of the car's body, 100 a second, and camera.yaml with the "
                  "camera's place on it; so do the next three");
  street
      .add_option("--pose-time-offset", arguments.pose_time_offset_s,
                  "seconds, -10 to 10, that have to be added to the stamps of body_poses.csv")
      .check(number_in(-kMost, kMost))
      .type_name("S");
  street
      .add_option("--lever-arm-error", arguments.lever_arm_error,
                  "metres, -10 to 10, of the true lever arm less the stated one, in the body's axes: "
                  "forward, left, up")
      .check(number_in(-kMost, kMost))
      .type_name("X Y Z");
  street
      .add_option("--boresight-error", arguments.boresight_error_deg,
                  "degrees, -10 to 10, by which the camera is turned out of the stated boresight: rotation "
                  "vector in the body's axes")
      .check(number_in(-kMost, kMost))
      .type_name("RX RY RZ");
}

/// Adds the errors of given poses.
void add_pose_errors(CommandLine& app, PoseErrorOptions& options, Arguments& arguments) {
  app.add_option("--pose-error", arguments.pose_error,
                 "standard deviations, metres along (0 to 100) and degrees about (0 to 10) each axis of the "
                 "world, of an error of the poses that wanders as that of GNSS/INS: also given_poses.txt, "
                 "poses with errors and their deviations, for --poses; the truth stays exact. With poses of "
                 "the body: given_body_poses.csv")
      .type_name("M DEG");
  app.add_option("--pose-error-time", options.correlation_time_s,
                 "seconds after which the correlation of that error has fallen to 1/e")
      .check(number_in(1e-3, 1e5))
      .show_default()
      .type_name("S");
  app.add_option("--pose-jitter", arguments.pose_jitter,
                 "as --pose-error, of an error that is new in each pose; one does not need the other")
      .type_name("M DEG");
}

void add_street_options(CommandLine& street, SimulateStreetOptions& options, Arguments& arguments) {
  add_shared_options(street, options, arguments);
  add_noise_option(street, "camera", "camera: image noise and varying gain", arguments);
  street.add_option("--baseline", options.baseline, "metres between the two cameras")
      .show_default()
      .type_name("B");
  street
      .add_option("--route", arguments.route,
                  "block: around a block; straight: along one street, at constant speed")
      .check(one_of({"block", "straight"}))
      .show_default()
      .type_name("NAME");
  add_planted_errors(street, options, arguments);
  add_body_poses(street, arguments);
  add_pose_errors(street, options.pose_error, arguments);
  street.add_flag(
      "--depth-truth", arguments.depth_truth,
      "also the left camera's true depth, 16 bit, 1/256 m, as cairn evaluate --landmarks needs it");
}

/// Takes the errors of given poses from the command line. Throws InputError if a time is stated for none.
void take_pose_errors(const Arguments& arguments, PoseErrorOptions& options) {
  constexpr PoseErrorOptions kDefault;
  const bool wanders = arguments.pose_error[0] > 0 || arguments.pose_error[1] > 0;
  if (!wanders && options.correlation_time_s != kDefault.correlation_time_s)
    throw InputError({"--pose-error-time", 0, "an error that wanders, --pose-error M DEG", "none",
                      "State --pose-error as well, or leave out --pose-error-time."});
  options.position_std = arguments.pose_error[0];
  options.rotation_std_deg = arguments.pose_error[1];
  options.jitter_position_std = arguments.pose_jitter[0];
  options.jitter_rotation_std_deg = arguments.pose_jitter[1];
}

void print_report(const Arguments& arguments, const SimulationReport& report, const std::string& folder,
                  const std::string& next) {
  const SimulationSummary summary{report, folder, arguments.common.seed, next};
  fmt::print("{}", arguments.common.json ? format_simulation_json(summary) : format_simulation_text(summary));
}

/// Returns the command that a user would run next: with poses that err, a map of these.
std::string next_command(const PoseErrorOptions& error, const std::string& folder, const std::string& given,
                         const std::string& otherwise) {
  return error.is_any() ? fmt::format("cairn map {0} --poses {0}/{1} -o map", folder, given) : otherwise;
}

void simulate_room(const Arguments& arguments, SimulateRoomOptions options) {
  options.seed = arguments.common.seed;
  options.camera = resized(options.camera, arguments.scale);
  if (arguments.noise == "none") options.noise = RgbdNoise::none;
  take_pose_errors(arguments, options.pose_error);
  options.validate();
  OutputFolder output(arguments.output, "sequence");
  const auto progress = make_progress(arguments.common);
  const Executor executor(arguments.common.thread_count());
  const SimulationReport report =
      write_tum(SimulatedRoom(options, executor), output.work(), executor, *progress, arguments.depth_truth);
  output.commit();
  const std::string folder = output.target().string();
  print_report(arguments, report, folder,
               next_command(options.pose_error, folder, "given_poses.txt",
                            fmt::format("cairn slam {} -o run", folder)));
}

Eigen::Vector3d vector_of(const std::array<double, 3>& values) {
  return {values[0], values[1], values[2]};
}

/// Returns the poses of the body that were asked for, by the flag or by one of their errors.
std::optional<SimulatedBodyPoses> body_poses_of(const Arguments& arguments) {
  SimulatedBodyPoses poses;
  poses.time_offset_s = arguments.pose_time_offset_s;
  poses.lever_arm_error = vector_of(arguments.lever_arm_error);
  poses.boresight_error_deg = vector_of(arguments.boresight_error_deg);
  const bool are_wrong =
      poses.time_offset_s != 0 || !poses.lever_arm_error.isZero(0) || !poses.boresight_error_deg.isZero(0);
  return arguments.body_poses || are_wrong ? std::optional(poses) : std::nullopt;
}

void simulate_street(const Arguments& arguments, SimulateStreetOptions options) {
  options.seed = arguments.common.seed;
  options.camera = resized(options.camera, arguments.scale);
  if (arguments.noise == "none") options.noise = StreetNoise::none;
  options.right_rotation_deg = vector_of(arguments.right_rotation_deg);
  options.body_poses = body_poses_of(arguments);
  take_pose_errors(arguments, options.pose_error);
  if (arguments.route == "straight") options.route = StreetRoute::straight;
  options.validate();
  OutputFolder output(arguments.output, "sequence");
  const auto progress = make_progress(arguments.common);
  const Executor executor(arguments.common.thread_count());
  const SimulationReport report = write_kitti(SimulatedStreet(options, executor), output.work(),
                                              arguments.depth_truth, executor, *progress);
  output.commit();
  const std::string folder = output.target().string();
  const std::string given = options.body_poses ? "given_body_poses.csv" : "given_poses.txt";
  print_report(arguments, report, folder,
               next_command(options.pose_error, folder, given, fmt::format("cairn info {}", folder)));
}

}  // namespace

int run_simulate(int argc, char** argv) {
  CommandLine app("A simulated recording with exact truth.", "simulate");
  app.footer("Example: cairn simulate room -o demo/room");
  Arguments arguments;
  SimulateRoomOptions room_options;
  SimulateStreetOptions street_options;

  CommandLine& room = app.add_command("room", "furnished room seen by a hand-held RGB-D camera, TUM layout");
  add_shared_options(room, room_options, arguments);
  add_noise_option(room, "kinect", "kinect: noise and holes of a Kinect v1", arguments);
  room.add_option("--depth-noise", room_options.depth_noise,
                  "standard deviation of the depth, 0 to 100 times a Kinect's")
      .check(number_in(0, 100))
      .show_default()
      .type_name("FACTOR");
  room.add_flag("--depth-truth", arguments.depth_truth,
                "also the true depth, as the depth images, which cairn evaluate --landmarks needs");
  add_pose_errors(room, room_options.pose_error, arguments);

  CommandLine& street = app.add_command("street", "drive around a block with a stereo camera, KITTI layout");
  add_street_options(street, street_options, arguments);

  if (const auto code = app.parse(argc, argv)) return *code;
  room.parsed() ? simulate_room(arguments, room_options) : simulate_street(arguments, street_options);
  return 0;
}

}  // namespace cairn::app
