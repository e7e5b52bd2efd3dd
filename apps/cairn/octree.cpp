// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/dense/octree_file.h"
#include "commands.h"
#include "fusion.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct OctreeArguments {
  CommonOptions common;
  SequenceArguments sequence;  // its folder may be a cloud file
  PoseArguments poses;
  std::string output;
  OccupancyOptions options;
};

void declare(CommandLine& app, OctreeArguments& arguments) {
  app.add_option("INPUT", arguments.sequence.folder,
                 "folder with an RGB-D sequence, or a cloud, .ply or .pcd (occupied space only)")
      .required();
  app.add_option("-o", arguments.output,
                 ".bt: occupied and free; .ot: probabilities, and colours where there are any")
      .type_name("FILE")
      .required();
  add_pose_options(app, arguments.poses);
  app.add_option("--resolution", arguments.options.resolution, "metres; size of the smallest cubes")
      .type_name("M")
      .show_default();
  app.add_option("--max-range", arguments.options.max_range,
                 "metres from the camera; farther points only free the way up to there")
      .type_name("M")
      .show_default();
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.threads = true});
  app.footer(
      "Examples: cairn octree demo/room --poses run/trajectory.txt -o room.ot\n"
      "          cairn octree room.ply -o room.bt --resolution 0.1");
}

struct Result {
  std::optional<FusionReport> fusion;  // not from a cloud file
  std::size_t points = 0;              // of a cloud file
  OctreeContents contents = OctreeContents::binary;
  OctreeFileReport file;
  OccupancyGrid::Counts counts;
  double seconds = 0;
};

void print_text(const OctreeArguments& arguments, const Result& result) {
  if (result.fusion) {
    print_report(*result.fusion);
  } else {
    fmt::print("points       {}\n", result.points);
  }
  fmt::print("voxels       {} occupied, {} free, of {} m\n", result.counts.occupied, result.counts.free,
             arguments.options.resolution);
  fmt::print("file         {}, {}, {} nodes: {}\n", arguments.output, format_bytes(result.file.bytes),
             result.file.nodes, to_string(result.contents));
  fmt::print("seconds      {:.2f}\n", result.seconds);
}

void print_json(const OctreeArguments& arguments, const Result& result) {
  nlohmann::ordered_json json = {{"output", arguments.output}};
  if (result.fusion) {
    json["frames"] = to_json(*result.fusion);
  } else {
    json["points"] = result.points;
  }
  json["resolution_m"] = arguments.options.resolution;
  json["occupied"] = result.counts.occupied;
  json["free"] = result.counts.free;
  json["nodes"] = result.file.nodes;
  json["contents"] = to_string(result.contents);
  json["bytes"] = result.file.bytes;
  json["seconds"] = result.seconds;
  fmt::print("{}\n", json.dump(2));
}

void fuse_input(const OctreeArguments& arguments, OccupancyGrid& grid, Result& result) {
  if (is_cloud_file(arguments.sequence.folder)) {
    const Cloud cloud = read_cloud(arguments.sequence.folder);
    grid.add_cloud(cloud);
    result.points = cloud.points.size();
    return;
  }
  const PosedSequence posed = open_posed_sequence(arguments.sequence, arguments.poses);
  const auto progress = make_progress(arguments.common);
  check_recording(posed.sequence, *progress);
  const Executor executor(arguments.common.thread_count());
  result.fusion =
      fuse_sequence(posed.sequence, posed.world_from_camera, {.occupancy = &grid}, executor, *progress);
}

Result build_octree(const OctreeArguments& arguments) {
  const Stopwatch watch;
  OccupancyGrid grid(arguments.options);
  Result result;
  fuse_input(arguments, grid, result);
  result.contents = octree_contents(arguments.output, grid.colored());
  result.file = write_octree(arguments.output, grid, result.contents);
  result.counts = grid.counts();
  result.seconds = watch.seconds();
  return result;
}

void require_no_sequence_options(const OctreeArguments& arguments) {
  const SequenceArguments& sequence = arguments.sequence;
  for (const auto& [name, value] : {std::pair{"--poses", arguments.poses.path},
                                    {"--camera", sequence.camera},
                                    {"--frames", sequence.frames},
                                    {"--without", sequence.without}}) {
    if (value.empty()) continue;
    throw InputError({name, 0, "a sequence with this option", "a cloud file",
                      "A cloud has no frames; leave the option out, or name a sequence."});
  }
}

}  // namespace

int run_octree(int argc, char** argv) {
  OctreeArguments arguments;
  CommandLine app("Occupied and free space as an OctoMap file.", "octree");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.options.validate();
  (void)octree_contents(arguments.output, true);  // a wrong extension is known before the work
  if (is_cloud_file(arguments.sequence.folder)) require_no_sequence_options(arguments);
  const AtomicFile probe(arguments.output);  // so is a path that cannot be written

  const Result result = build_octree(arguments);
  arguments.common.json ? print_json(arguments, result) : print_text(arguments, result);
  return 0;
}

}  // namespace cairn::app
