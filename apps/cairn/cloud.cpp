// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/image/codec.h"
#include "cairn/report/fusion_report.h"
#include "cairn/report/overview.h"
#include "commands.h"
#include "fusion.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct CloudArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments poses;
  std::string output, picture;
  CloudOptions options;
};

void declare(CommandLine& app, CloudArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with an RGB-D sequence").required();
  app.add_option("-o", arguments.output, "the cloud, .ply or .pcd").type_name("FILE").required();
  add_pose_options(app, arguments.poses);
  app.add_option("--voxel", arguments.options.voxel_size, "metres; one point for each voxel of this size")
      .type_name("M")
      .show_default();
  app.add_option("--max-depth", arguments.options.max_depth, "metres; deeper readings are too noisy")
      .type_name("M")
      .show_default();
  app.add_option("--draw", arguments.picture, "a picture of the cloud, obliquely from above")
      .type_name("PNG");
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.threads = true});
  app.footer("Example: cairn cloud demo/room --poses run/trajectory.txt -o room.ply");
}

/// The path without the gaps where frames have no pose.
CameraPath path_of(const PosedSequence& posed) {
  CameraPath path;
  for (const auto& pose : posed.world_from_camera)
    if (pose) path.world_from_camera.push_back(*pose);
  return path;
}

CloudReport build_cloud(const CloudArguments& arguments) {
  const Stopwatch watch;
  const PosedSequence posed = open_posed_sequence(arguments.sequence, arguments.poses);
  const auto progress = make_progress(arguments.common);
  check_recording(posed.sequence, *progress);
  const Executor executor(arguments.common.thread_count());
  CloudBuilder builder(arguments.options);
  CloudReport report;
  report.output = arguments.output;
  report.picture = arguments.picture;
  report.voxel_m = arguments.options.voxel_size;
  report.fusion =
      fuse_sequence(posed.sequence, posed.world_from_camera, {.cloud = &builder}, executor, *progress);
  const Cloud cloud = builder.take();
  write_cloud(arguments.output, cloud);
  if (!arguments.picture.empty())
    write_png(arguments.picture, draw_overview(cloud, path_of(posed), arguments.options.voxel_size));
  report.points = cloud.points.size();
  report.bounds = bounds_of(cloud);
  report.bytes = static_cast<std::int64_t>(std::filesystem::file_size(arguments.output));
  report.seconds = watch.seconds();
  return report;
}

}  // namespace

int run_cloud(int argc, char** argv) {
  CloudArguments arguments;
  CommandLine app("One coloured cloud from all frames of a sequence whose poses are known.", "cloud");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  arguments.options.validate();
  require_cloud_file(arguments.output);
  const AtomicFile probe(arguments.output);  // a path that cannot be written is known before the work
  std::optional<AtomicFile> picture_probe;
  if (!arguments.picture.empty()) picture_probe.emplace(arguments.picture);

  const CloudReport report = build_cloud(arguments);
  fmt::print("{}", arguments.common.json ? format_cloud_json(report) : format_cloud_text(report));
  return 0;
}

}  // namespace cairn::app
