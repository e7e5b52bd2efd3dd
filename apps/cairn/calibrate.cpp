// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/report/calibration_report.h"
#include "cairn/sequence/pose_path.h"
#include "calibrate_parameters.h"
#include "commands.h"
#include "common.h"
#include "parameter_arguments.h"
#include "pose_arguments.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

struct CalibrateArguments {
  CommonOptions common;
  SequenceArguments sequence;
  PoseArguments poses;
  std::string output;
  bool apply_baseline = false;
};

void declare(CommandLine& app, CalibrateArguments& arguments) {
  app.add_option("SEQ", arguments.sequence.folder, "folder with a stereo or RGB-D sequence").required();
  app.add_option("-o,--output", arguments.output,
                 "calibration to write; a file that exists is never replaced")
      .type_name("CAMERA.yaml")
      .required();
  app.add_flag("--apply-baseline", arguments.apply_baseline,
               "also correct the baseline (of RGB-D, the scale of depth) if the poses show that it is off");
  add_pose_options(app, arguments.poses);
  add_sequence_options(app, arguments.sequence);
  add_common_options(app, arguments.common, {.config = true, .threads = true, .seed = true});
  app.footer(
      "Example: cairn calibrate SEQ -o camera.yaml; cairn slam SEQ --camera camera.yaml -o RUN\n"
      "         cairn calibrate SEQ --poses gnss.csv -o camera.yaml\n"
      "Exit code 1: the recording determines nothing; nothing is written. --set and --config take the\n"
      "parameters of cairn slam.");
}

/// Looks before the work at what would make writing fail after it.
void require_new(const std::string& output) {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::absolute(output, ignored).parent_path();
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError({output, 0, "a file in a folder that exists", "none", "Make the folder first."});
  if (std::filesystem::symlink_status(output, ignored).type() == std::filesystem::file_type::not_found)
    return;
  throw InputError({output, 0, "the name of a new file", "one that exists",
                    "Choose another name; a calibration is never replaced."});
}

CalibrateParameters gather_parameters(const CalibrateArguments& arguments) {
  CalibrateParameters parameters;
  parameters.sequence = arguments.sequence.options();
  apply_settings(arguments.common, table_of(parameters));
  parameters.slam.seed = arguments.common.seed;
  parameters.slam.validate();
  return parameters;
}

/// Reads the poses that were named, or the sequence's own; nullopt if it has none.
std::optional<GivenPath> read_poses(const Sequence& sequence, const PoseArguments& arguments) {
  if (arguments.path.empty() && !sequence.truth && !oxts_in(sequence.folder)) return std::nullopt;
  GivenPath given = read_given_path(sequence, arguments.options());
  print_warnings(given.warnings);
  return given;
}

/// Warns of poses that determine nothing, though there may be another answer.
void warn_of_poses(const CalibrationResult& result, const std::optional<GivenPath>& given) {
  if (!given || !result.poses) return;
  const auto& findings = result.poses->findings;
  const bool says_nothing = std::all_of(findings.begin(), findings.end(),
                                        [](Finding finding) { return finding == Finding::undetermined; });
  if (says_nothing)
    fmt::print(stderr, "cairn calibrate: the poses of {} determine nothing: {}\n", given->source.string(),
               result.poses->why[0]);
}

int report_no_answer() {
  fmt::print(stderr, "cairn calibrate: the recording determines nothing; nothing was written.\n");
  return 1;
}

}  // namespace

int run_calibrate(int argc, char** argv) {
  CalibrateArguments arguments;
  CommandLine app(
      "What is wrong with the calibration of a stereo or RGB-D recording, how sure that is, and a "
      "camera.yaml "
      "for later runs. With poses also the baseline, their time offset, and where the camera sits on their "
      "body.",
      "calibrate");
  declare(app, arguments);
  if (const auto code = app.parse(argc, argv)) return *code;
  require_new(arguments.output);
  const CalibrateParameters parameters = gather_parameters(arguments);
  const Sequence sequence = open_sequence(arguments.sequence.folder, parameters.sequence);
  print_warnings(sequence.report.warnings);
  const std::optional<GivenPath> given = read_poses(sequence, arguments.poses);
  const auto progress = make_progress(arguments.common);
  check_recording(sequence, *progress);
  const Executor executor(arguments.common.thread_count());
  const CalibrationResult result =
      calibrate(sequence, given, {parameters.slam, arguments.apply_baseline}, executor, *progress);
  warn_of_poses(result, given);
  const bool has_answer = result.has_answer();
  require_new(arguments.output);
  if (has_answer) write_file(arguments.output, format_calibration(result.calibration));
  const CalibrationSummary summary{result, given, has_answer ? arguments.output : ""};
  fmt::print("{}",
             arguments.common.json ? format_calibration_json(summary) : format_calibration_text(summary));
  return has_answer ? 0 : report_no_answer();
}

}  // namespace cairn::app
