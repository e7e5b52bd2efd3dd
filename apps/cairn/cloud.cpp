// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/image/codec.h"
#include "cairn/report/fusion_report.h"
#include "cairn/report/overview.h"
#include "cairn/sequence/image_pair.h"
#include "commands.h"
#include "fusion.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct CloudArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments poses;
  std::string depth, output, picture;
  CloudOptions options;
};

void declare(CommandLine& app, CloudArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with an RGB-D sequence, or one colour image")
      .required();
  app.add_option("DEPTH", arguments.depth, "the depth image of that colour image; needs --camera");
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
  app.footer(
      "Example: cairn cloud demo/room --poses run/trajectory.txt -o room.ply\n"
      "         cairn cloud rgb.png depth.png --camera 518,519,325.5,253.5,1000 -o pair.ply");
}

/// The path without the gaps where frames have no pose.
CameraPath path_of(const PosedSequence& posed) {
  CameraPath path;
  for (const auto& pose : posed.world_from_camera)
    if (pose) path.world_from_camera.push_back(*pose);
  return path;
}

/// Nothing that chooses frames or their poses has a meaning for two images.
void check_pair(const CloudArguments& arguments) {
  const auto& sequence = arguments.sequence;
  for (const auto& [option, given] : {std::pair{"--poses", arguments.poses.path},
                                      {"--frames", sequence.frames},
                                      {"--without", sequence.without}}) {
    if (!given.empty())
      throw InputError({option, 0, "a sequence", "two images, which are one frame", "Leave it out."});
  }
  if (sequence.camera.empty())
    throw InputError({"--camera", 0, "the camera of the two images", "none",
                      "Give --camera fx,fy,cx,cy,scale or --camera FILE."});
}

/// The sequence, or two images, whose world is the camera's frame.
PosedSequence open_input(const CloudArguments& arguments) {
  if (arguments.depth.empty()) return open_posed_sequence(arguments.sequence, arguments.poses);
  check_pair(arguments);
  return {open_image_pair(arguments.sequence.folder, arguments.depth, arguments.sequence.camera),
          {WorldFromCamera()}};
}

CloudReport build_cloud(const CloudArguments& arguments) {
  const Stopwatch watch;
  const PosedSequence posed = open_input(arguments);
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
  CommandLine app(
      "One coloured cloud from all frames of a sequence whose poses are known, or from one colour and one "
      "depth "
      "image.",
      "cloud");
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
