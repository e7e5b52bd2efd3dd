// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/core/stopwatch.h"
#include "cairn/map/colmap_export.h"
#include "cairn/report/landmark_ply.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/survey/survey.h"
#include "commands.h"
#include "common.h"
#include "map_outputs.h"
#include "map_parameters.h"
#include "pose_arguments.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct MapArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments poses;
  std::string output, exported;
};

void declare(CLI::App& app, MapArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with a stereo or RGB-D sequence")->required();
  app.add_option("-o,--output", arguments.output, "map folder; one that cairn wrote is replaced")
      ->type_name("MAP")
      ->required();
  app.add_option("--export", arguments.exported, "also the model in another program's files, in MAP/colmap")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"colmap"}, CLI::ignore_case));
  add_pose_options(app, arguments.poses);
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.config = true, .threads = true});
  app.footer([] {
    return "Example: cairn map SEQ --poses poses.txt -o map\n"
           "         cairn map SEQ --poses gnss.csv -o map --export colmap\n"
           "Stopped by Ctrl-C or killed, the same command goes on where it was: what is done lies in "
           "MAP.unfinished.\n"
           "Parameters for --set and --config with their defaults; the README says what they mean:\n" +
           MapParameters().table().format();
  });
}

MapParameters gather_parameters(const MapArguments& arguments) {
  MapParameters parameters;
  parameters.sequence = arguments.sequence.options();
  const SettingTable table = parameters.table();
  if (!arguments.common.config.empty()) {
    for (const Setting& setting : read_settings(arguments.common.config)) table.apply(setting);
  }
  for (const std::string& text : arguments.common.settings) table.apply(parse_setting(text, "--set"));
  parameters.survey.validate();
  return parameters;
}

int report_stop(const SurveyResult& result, const MapSummary& summary) {
  fmt::print(stderr, "cairn map: stopped after {} of {} frames. The same command goes on from there.\n",
             result.counts.frames, summary.sequence_frames);
  return 1;
}

/// A map without landmarks is no answer.
int warn_if_empty(const SurveyResult& result) {
  if (result.counts.landmarks > 0) return 0;
  fmt::print(stderr,
             "cairn map: not one landmark: {} tracks of features, {} in too few frames, {} that contradict "
             "the poses.\n  Look at the calibration, the poses' frame ('cairn info SEQ') and "
             "--pose-offset.\n",
             result.counts.tracks, result.counts.too_short, result.counts.contradictory);
  return 1;
}

}  // namespace

int run_map(int argc, char** argv) {
  MapArguments arguments;
  CLI::App app(
      "Mapping with known poses: a stereo or RGB-D sequence and its trajectory become a map of landmarks "
      "with "
      "covariances and descriptors.",
      "map");
  declare(app, arguments);
  if (const auto code = parse(app, argc, argv)) return *code;

  const Stopwatch watch;
  MapParameters parameters = gather_parameters(arguments);
  const std::string settings = parameters.table().format();
  const Sequence sequence = open_sequence(arguments.sequence.folder, parameters.sequence);
  const GivenPoses poses = read_given_poses(sequence, arguments.poses.options());
  const auto progress = make_progress(arguments.common);
  check_recording(sequence, *progress);
  OutputFolder folder(arguments.output, "map", has_unfinished_survey);
  const Executor executor(arguments.common.thread_count());
  const SurveyResult result =
      run_survey({sequence, poses, settings}, parameters.survey, folder.work(), executor, *progress);
  MapSummary summary{arguments.output, poses.format, static_cast<std::int64_t>(sequence.frames.size()),
                     executor.threads(), watch.seconds()};
  if (result.stopped) return report_stop(result, summary);
  write_file(folder.work() / "report.json", format_map_report(result));
  write_file(folder.work() / "config.yaml", settings);
  write_landmark_ply(folder.work(), folder.work() / "landmarks.ply");
  if (!arguments.exported.empty()) write_colmap_model(folder.work(), folder.work() / "colmap");
  folder.commit();
  summary.total_seconds = watch.seconds();
  arguments.common.json ? fmt::print("{}", format_map_json(result, summary))
                        : print_map_summary(result, summary);
  return warn_if_empty(result);
}

}  // namespace cairn::app
