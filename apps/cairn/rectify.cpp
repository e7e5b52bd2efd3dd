// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "cairn/core/file.h"
#include "cairn/report/recording_report.h"
#include "cairn/simulate/write_kitti.h"
#include "commands.h"
#include "common.h"
#include "recording_checks.h"

namespace cairn::app {
int run_rectify(int argc, char** argv) {
  CommandLine app("The rectified pairs of a stereo sequence, in KITTI layout.", "rectify");
  CommonOptions common;
  SequenceArguments arguments;
  std::string output;
  app.add_option("SEQ", arguments.folder, "folder with a stereo sequence").required();
  app.add_option("-o,--output", output, "folder to write; a folder that cairn wrote is replaced")
      .required()
      .type_name("DIR");
  add_sequence_options(app, arguments);
  add_common_options(app, common, {.threads = true});
  app.footer("Example: cairn rectify V1_01_easy -o rectified");
  if (const auto code = app.parse(argc, argv)) return *code;
  const Sequence sequence = open_sequence(arguments.folder, arguments.options());
  print_warnings(sequence.report.warnings);
  const auto progress = make_progress(common);
  check_recording(sequence, *progress);
  OutputFolder folder(output, "sequence");
  const RectifiedReport report =
      write_rectified(sequence, folder.work(), Executor(common.thread_count()), *progress);
  folder.commit();
  const std::string target = folder.target().string();
  fmt::print("{}",
             common.json ? format_rectified_json(report, target) : format_rectified_text(report, target));
  return 0;
}

}  // namespace cairn::app
