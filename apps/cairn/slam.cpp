// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/file.h"
#include "cairn/map_files/map_file.h"
#include "cairn/report/slam_report.h"
#include "commands.h"
#include "common.h"
#include "fusion.h"
#include "parameter_arguments.h"
#include "recording_checks.h"
#include "slam_outputs.h"
#include "slam_parameters.h"

namespace cairn::app {
namespace {

struct SlamArguments {
  CommonOptions common;
  SequenceArguments sequence;
  std::string output, map;
  bool odometry = false, no_cloud = false, no_octree = false;
};

void declare(CommandLine& app, SlamArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with an RGB-D or stereo sequence").required();
  app.add_option("-o,--output", arguments.output, "run folder; one that cairn wrote is replaced")
      .type_name("RUN")
      .required();
  app.add_option("--map", arguments.map, "go on from the map of an earlier run: its folder, or the run's")
      .type_name("MAP");
  app.add_flag("--odometry", arguments.odometry, "track only: no loop closures, no pose graph");
  app.add_flag("--no-cloud", arguments.no_cloud, "write no coloured cloud");
  app.add_flag("--no-octree", arguments.no_octree, "write no octree");
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.config = true, .threads = true, .seed = true});
  add_parameter_help(
      app,
      "Example: cairn slam demo/room -o demo/run\n"
      "         cairn slam SEQ2 -o RUN2 --map RUN\n"
      "         cairn slam SEQ -o RUN --set features=1000 --set keyframe_threshold=0.2\n"
      "RUN/config.yaml holds the parameters of a run, for --config of another. Without --config, "
      "parameters.txt in SEQ or where the program runs is taken, if there is one.\n",
      default_rows<SlamParameters>);
}

SlamParameters gather_parameters(SlamArguments& arguments) {
  SlamParameters parameters;
  parameters.sequence = arguments.sequence.options();
  find_parameter_file(arguments.sequence.folder, table_of(parameters), arguments.common);
  apply_settings(arguments.common, table_of(parameters));
  parameters.slam.seed = arguments.common.seed;
  parameters.slam.odometry = arguments.odometry;
  parameters.validate();
  return parameters;
}

int report_nothing_tracked(const SlamResult& result) {
  fmt::print(
      stderr,
      "cairn slam: no frame could be tracked: none of {} frames had enough features with depth to begin a "
      "map.\n"
      "  Look at the images and the depth; 'cairn info SEQ' shows the calibration. Nothing was written.\n",
      result.frames.size());
  return 1;
}

/// A map of its first frame only is no answer.
int warn_if_never_followed(const SlamResult& result) {
  if (result.frames.size() < 2 || result.trajectory().size() > 1) return 0;
  const auto is_too_far = [](const TrackingResult& track) {
    return track.status == TrackingStatus::implausible;
  };
  if (std::any_of(result.frames.begin(), result.frames.end(), is_too_far)) {
    fmt::print(stderr, "cairn slam: no motion below max_motion was found between any two of {} frames.\n",
               result.frames.size());
    return 1;
  }
  if (result.start_keyframes > 0) {
    fmt::print(
        stderr,
        "cairn slam: none of {} frames was recognised in the start map.\n  Is it a map of this place?\n",
        result.frames.size());
    return 1;
  }
  fmt::print(stderr,
             "cairn slam: no motion was found between any two of {} frames: they may lie too far apart, or "
             "the calibration "
             "does not belong to them.\n  Look at RUN/frames.csv; more frames per second, or --set "
             "features=3000, may help.\n",
             result.frames.size());
  return 1;
}

}  // namespace

int run_slam(int argc, char** argv) {
  SlamArguments arguments;
  CommandLine app(
      "SLAM: an RGB-D or stereo sequence without poses becomes a trajectory and a map; with depth images "
      "also a "
      "coloured cloud and an octree.",
      "slam");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;

  const Stopwatch watch;
  SlamParameters parameters = gather_parameters(arguments);
  const Sequence sequence = open_sequence(arguments.sequence.folder, parameters.sequence);
  print_warnings(sequence.report.warnings);
  const auto progress = make_progress(arguments.common);
  check_recording(sequence, *progress);
  const bool has_depth = sequence.calibration.depth.has_value();  // stereo has none to fuse
  const SlamOutputs wanted{has_depth && !arguments.no_cloud, has_depth && !arguments.no_octree};
  OutputFolder folder(arguments.output, "run");
  const Executor executor(arguments.common.thread_count());

  std::optional<Map> start;
  if (!arguments.map.empty()) start = read_map(arguments.map);
  const SlamResult result = cairn::run_slam(sequence, parameters.slam, executor, *progress, std::move(start));
  if (result.map.keyframes().empty()) return report_nothing_tracked(result);
  SlamSummary summary;
  summary.folder = arguments.output;
  summary.threads = executor.threads();
  summary.seed = parameters.slam.seed;
  summary.odometry = parameters.slam.odometry;
  write_slam_files(folder.work(), sequence, result, parameters);
  write_dense_files(folder.work(), sequence, result, parameters, wanted, executor, *progress, summary);
  add_accuracy(sequence, result, summary);
  summary.total_seconds = watch.seconds();
  summary.peak_memory_mb = peak_memory_mb();
  const std::string json = format_slam_json(sequence, result, summary);
  write_file(folder.work() / "run.json", json);
  folder.commit();
  fmt::print("{}", arguments.common.json ? json : format_slam_text(sequence, result, summary));
  return warn_if_never_followed(result);
}

}  // namespace cairn::app
