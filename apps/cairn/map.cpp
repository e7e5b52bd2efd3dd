// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/core/stopwatch.h"
#include "cairn/map_files/colmap_export.h"
#include "cairn/map_files/colmap_sources.h"
#include "cairn/report/landmark_ply.h"
#include "cairn/report/survey_report.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/survey/diagnosis.h"
#include "cairn/survey/survey.h"
#include "commands.h"
#include "common.h"
#include "map_parameters.h"
#include "map_pictures.h"
#include "parameter_arguments.h"
#include "pose_arguments.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct MapArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments poses;
  std::string output, exported;
  bool exact_poses = false;
};

void declare(CommandLine& app, MapArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with a stereo or RGB-D sequence").required();
  app.add_option("-o,--output", arguments.output, "map folder; one that cairn wrote is replaced")
      .type_name("MAP")
      .required();
  app.add_option("--export", arguments.exported, "also a sparse model for another program, in MAP/colmap")
      .type_name("FORMAT")
      .check(one_of_any_case({"colmap"}));
  add_pose_options(app, arguments.poses);
  app.add_flag("--exact-poses", arguments.exact_poses,
               "take the poses as they are, whatever the images say: pose_frames=0");
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.config = true, .threads = true});
  add_parameter_help(
      app,
      "Example: cairn map SEQ --poses poses.txt -o map\n"
      "         cairn map SEQ --poses gnss.csv -o map --export colmap\n"
      "Stopped by Ctrl-C or killed, the same command goes on where it was: what is done lies in "
      "MAP.unfinished.\n",
      default_rows<MapParameters>);
}

MapParameters gather_parameters(const MapArguments& arguments) {
  MapParameters parameters;
  parameters.sequence = arguments.sequence.options();
  apply_settings(arguments.common, table_of(parameters));
  if (arguments.exact_poses) parameters.survey.tracks.pose_frames = 0;
  parameters.survey.validate();
  return parameters;
}

int report_stop(const SurveyResult& result, const SurveySummary& summary) {
  fmt::print(stderr, "cairn map: stopped after {} of {} frames. The same command goes on from there.\n",
             result.counts.frames, summary.sequence_frames);
  return 1;
}

/// A map without landmarks is no answer.
int report_quality(const SurveyResult& result, const SurveyOptions& options) {
  if (result.counts.landmarks == 0) {
    fmt::print(stderr, "cairn map: {}\n", explain_no_landmarks(result, options));
    return 1;
  }
  if (const std::string said = describe_dominant_poses(result); !said.empty())
    fmt::print(stderr, "cairn map: {}\n", said);
  return 0;
}

}  // namespace

int run_map(int argc, char** argv) {
  MapArguments arguments;
  CommandLine app(
      "Mapping with known poses: a stereo or RGB-D sequence and its trajectory become a map of landmarks "
      "with "
      "covariances and descriptors.",
      "map");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;

  const Stopwatch watch;
  MapParameters parameters = gather_parameters(arguments);
  const std::string settings = table_of(parameters).format();
  const Sequence sequence = open_sequence(arguments.sequence.folder, parameters.sequence);
  print_warnings(sequence.report.warnings);
  if (!arguments.exported.empty()) check_colmap_names(sequence);
  const GivenPoses poses = read_given_poses(sequence, arguments.poses.options());
  print_warnings(poses.warnings);
  const auto progress = make_progress(arguments.common);
  check_recording(sequence, *progress);
  OutputFolder folder(arguments.output, "map", has_unfinished_survey);
  const Executor executor(arguments.common.thread_count());
  const SurveyResult result =
      run_survey({sequence, poses, settings}, parameters.survey, folder.work(), executor, *progress);
  SurveySummary summary{arguments.output,
                        poses.format,
                        static_cast<std::int64_t>(sequence.frames.size()),
                        executor.threads(),
                        watch.seconds(),
                        {},
                        0};
  if (result.stopped) return report_stop(result, summary);
  write_file(folder.work() / "report.json", format_survey_report(result));
  write_file(folder.work() / "config.yaml", settings);
  write_landmark_ply(folder.work(), folder.work() / "landmarks.ply");
  write_map_picture(folder.work(), folder.work());
  if (!arguments.exported.empty()) {
    write_colmap_model(folder.work(), sequence, folder.work() / "colmap", executor, *progress);
    summary.image_root = colmap_image_root(sequence).string();
  }
  folder.commit();
  summary.total_seconds = watch.seconds();
  summary.peak_memory_mb = peak_memory_mb();
  fmt::print("{}", arguments.common.json ? format_survey_json(result, summary)
                                         : format_survey_text(result, summary));
  return report_quality(result, parameters.survey);
}

}  // namespace cairn::app
