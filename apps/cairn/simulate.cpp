// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cairn/core/file.h"
#include "cairn/sequence/write_tum.h"
#include "commands.h"
#include "common.h"

namespace cairn::app {
namespace {

struct Arguments {
  CommonOptions common;
  std::string output;
  double scale = 1;  ///< of the image size
};

/// What every simulated sequence has.
void add_shared_options(CLI::App& app, Arguments& arguments) {
  app.add_option("-o,--output", arguments.output, "folder to write; a folder that cairn wrote is replaced")
      ->required()
      ->type_name("DIR");
  app.add_option("--scale", arguments.scale, "image width and height over the default's")
      ->check(CLI::Range(0.05, 4.0))
      ->capture_default_str()
      ->type_name("X");
  add_common_options(app, arguments.common, {.threads = true, .seed = true});
}

void add_room_options(CLI::App& app, SimulateRoomOptions& options) {
  app.add_option("--frames-count", options.frames_count, "frames, at 30 a second")
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--loops", options.loops, "times around the room; 0: as many as the way needs")
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--speed", options.speed, "metres a second")->capture_default_str()->type_name("V");
  const std::map<std::string, RgbdNoise> names{{"kinect", RgbdNoise::kinect}, {"none", RgbdNoise::none}};
  app.add_option("--noise", options.noise, "kinect: noise and holes of a Kinect v1 (default); none: exact")
      ->transform(CLI::CheckedTransformer(names).description(""))
      ->type_name("kinect|none");
}

void print_report(const Arguments& arguments, const std::string& kind, const std::string& folder,
                  const SimulationReport& report, const std::string& next) {
  if (arguments.common.json) {
    nlohmann::ordered_json json;
    json["kind"] = kind;
    json["folder"] = folder;
    json["frames"] = report.frames;
    json["duration_s"] = report.duration;
    json["path_m"] = report.length;
    json["seed"] = arguments.common.seed;
    json["stopped"] = report.stopped;
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("frames       {} over {:.2f} s{}\n", report.frames, report.duration,
             report.stopped ? ", stopped before the end" : "");
  fmt::print("path         {:.3f} m\n", report.length);
  fmt::print("written to   {}\n", folder);
  fmt::print("next         {}\n", next);
}

int simulate_room(const Arguments& arguments, SimulateRoomOptions options) {
  options.seed = arguments.common.seed;
  options.camera = resized(options.camera, arguments.scale);
  options.validate();
  OutputFolder output(arguments.output);
  const auto progress = make_progress(arguments.common);
  const Executor executor(arguments.common.thread_count());
  const SimulatedRoom room(options, executor);
  const SimulationReport report = write_tum(room, output.work(), executor, *progress);
  output.commit();
  const std::string folder = output.target().string();
  print_report(arguments, "room", folder, report, fmt::format("cairn slam {} -o run", folder));
  return 0;
}

}  // namespace

int run_simulate(int argc, char** argv) {
  CLI::App app("A simulated recording with exact truth.\n\nexample: cairn simulate room -o demo/room",
               "simulate");
  Arguments arguments;
  SimulateRoomOptions room_options;
  app.require_subcommand(1);
  CLI::App& room = *app.add_subcommand("room", "furnished room seen by a hand-held RGB-D camera, TUM layout");
  add_room_options(room, room_options);
  add_shared_options(room, arguments);
  if (const auto code = parse(app, argc, argv)) return *code;
  return simulate_room(arguments, room_options);
}

}  // namespace cairn::app
