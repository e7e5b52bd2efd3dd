// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/core/file.h"
#include "cairn/dense/cloud_file.h"
#include "cairn/image/codec.h"
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

struct Result {
  FusionReport fusion;
  std::size_t points = 0;
  CloudBounds bounds;
  std::int64_t bytes = 0;
  double seconds = 0;
};

void print_text(const CloudArguments& arguments, const Result& result) {
  const Eigen::Vector3f size = result.bounds.high - result.bounds.low;
  print_report(result.fusion);
  fmt::print("points       {}, one per {} m\n", result.points, arguments.options.voxel_size);
  fmt::print("box          {:.2f} x {:.2f} x {:.2f} m\n", size.x(), size.y(), size.z());
  fmt::print("file         {}, {}\n", arguments.output, format_bytes(result.bytes));
  if (!arguments.picture.empty()) fmt::print("picture      {}\n", arguments.picture);
  fmt::print("seconds      {:.2f}\n", result.seconds);
}

void print_json(const CloudArguments& arguments, const Result& result) {
  const auto corner = [](const Eigen::Vector3f& p) { return nlohmann::ordered_json{p.x(), p.y(), p.z()}; };
  nlohmann::ordered_json json = {{"output", arguments.output},
                                 {"frames", to_json(result.fusion)},
                                 {"points", result.points},
                                 {"voxel_m", arguments.options.voxel_size},
                                 {"box_low_m", corner(result.bounds.low)},
                                 {"box_high_m", corner(result.bounds.high)},
                                 {"bytes", result.bytes},
                                 {"seconds", result.seconds}};
  if (!arguments.picture.empty()) json["picture"] = arguments.picture;
  fmt::print("{}\n", json.dump(2));
}

/// The path without the gaps where frames have no pose.
CameraPath path_of(const PosedSequence& posed) {
  CameraPath path;
  for (const auto& pose : posed.world_from_camera)
    if (pose) path.world_from_camera.push_back(*pose);
  return path;
}

Result build_cloud(const CloudArguments& arguments) {
  const Stopwatch watch;
  const PosedSequence posed = open_posed_sequence(arguments.sequence, arguments.poses);
  const auto progress = make_progress(arguments.common);
  check_recording(posed.sequence, *progress);
  const Executor executor(arguments.common.thread_count());
  CloudBuilder builder(arguments.options);
  Result result;
  result.fusion =
      fuse_sequence(posed.sequence, posed.world_from_camera, {.cloud = &builder}, executor, *progress);
  const Cloud cloud = builder.take();
  write_cloud(arguments.output, cloud);
  if (!arguments.picture.empty())
    write_png(arguments.picture, draw_overview(cloud, path_of(posed), arguments.options.voxel_size));
  result.points = cloud.points.size();
  result.bounds = bounds_of(cloud);
  result.bytes = static_cast<std::int64_t>(std::filesystem::file_size(arguments.output));
  result.seconds = watch.seconds();
  return result;
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

  const Result result = build_cloud(arguments);
  arguments.common.json ? print_json(arguments, result) : print_text(arguments, result);
  return 0;
}

}  // namespace cairn::app
