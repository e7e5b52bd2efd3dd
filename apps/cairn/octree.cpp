// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/dense/octree_file.h"
#include "cairn/report/fusion_report.h"
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

void fuse_input(const OctreeArguments& arguments, OccupancyGrid& grid, OctreeReport& report) {
  if (is_cloud_file(arguments.sequence.folder)) {
    const Cloud cloud = read_cloud(arguments.sequence.folder);
    grid.add_cloud(cloud);
    report.points = cloud.points.size();
    return;
  }
  const PosedSequence posed = open_posed_sequence(arguments.sequence, arguments.poses);
  const auto progress = make_progress(arguments.common);
  check_recording(posed.sequence, *progress);
  const Executor executor(arguments.common.thread_count());
  report.fusion =
      fuse_sequence(posed.sequence, posed.world_from_camera, {.occupancy = &grid}, executor, *progress);
}

OctreeReport build_octree(const OctreeArguments& arguments) {
  const Stopwatch watch;
  OccupancyGrid grid(arguments.options);
  OctreeReport report;
  report.output = arguments.output;
  report.resolution_m = arguments.options.resolution;
  fuse_input(arguments, grid, report);
  report.contents = octree_contents(arguments.output, grid.colored());
  report.file = write_octree(arguments.output, grid, report.contents);
  report.counts = grid.counts();
  report.seconds = watch.seconds();
  return report;
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

  const OctreeReport report = build_octree(arguments);
  fmt::print("{}", arguments.common.json ? format_octree_json(report) : format_octree_text(report));
  return 0;
}

}  // namespace cairn::app
