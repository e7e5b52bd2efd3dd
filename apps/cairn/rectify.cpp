// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cairn/core/file.h"
#include "cairn/sequence/write_kitti.h"
#include "commands.h"
#include "common.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

void print_report(const RectifiedReport& report, const std::string& folder, bool as_json) {
  if (as_json) {
    const nlohmann::ordered_json json = {{"frames", report.frames},
                                         {"unreadable", report.unreadable},
                                         {"poses", report.has_poses},
                                         {"stopped", report.stopped},
                                         {"folder", folder}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("frames       {}{}\n", report.frames, report.stopped ? ", stopped before the end" : "");
  if (report.unreadable > 0) fmt::print("unreadable   {} frames, skipped\n", report.unreadable);
  fmt::print("poses        {}\n",
             report.has_poses ? "of every frame" : "none: not every frame has a true one");
  fmt::print("written to   {}\n", folder);
}

}  // namespace

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
  print_report(report, folder.target().string(), common.json);
  return 0;
}

}  // namespace cairn::app
