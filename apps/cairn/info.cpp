// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdint>
#include <exception>

#include "cairn/core/error.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_statistics.h"
#include "cairn/report/map_report.h"
#include "cairn/report/sequence_report.h"
#include "cairn/sequence/skipped_frames.h"
#include "commands.h"
#include "common.h"
#include "recording_checks.h"

namespace cairn::app {
namespace {

/// Looks at all images, and decodes those of one frame. InputError where no frame can be read.
std::int64_t count_unreadable(const Sequence& sequence, Progress& progress) {
  const FrameLoader loader(sequence);
  SkippedFrames skipped(progress);
  bool any_decoded = false;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const FrameId id{static_cast<std::int32_t>(i)};
    try {
      loader.probe(id);
      if (!any_decoded) (void)loader.load(id);
      any_decoded = true;
      skipped.take();
    } catch (const InputError&) {
      skipped.skip(std::current_exception());
    }
  }
  skipped.finish();
  return skipped.count();
}

/// What chooses from a sequence would do nothing for a map.
void require_no_choice(const CommandLine& app) {
  for (const char* option :
       {"--camera", "--frames", "--without", "--left", "--right", "--color", "--depth"}) {
    if (app.count(option) > 0)
      throw InputError({option, 0, "a sequence to apply it to", "a map", "Leave the option out."});
  }
}

}  // namespace

int run_info(int argc, char** argv) {
  CommandLine app("What a sequence or a map is: format, frames, cameras, truth; keyframes, landmarks.",
                  "info");
  CommonOptions common;
  SequenceArguments arguments;
  app.add_option("SEQ", arguments.folder, "folder with a sequence, a map, or a run with its map").required();
  add_sequence_options(app, arguments);
  add_common_options(app, common, {.quiet = false});
  app.footer("Example: cairn info demo/room");
  if (const auto code = app.parse(argc, argv)) return *code;
  if (const auto map = find_map_folder(arguments.folder)) {
    require_no_choice(app);
    const MapStatistics figures = read_map_statistics(*map);
    fmt::print("{}", common.json ? format_map_json(*map, figures) : format_map_text(*map, figures));
    return 0;
  }
  const Sequence sequence = open_sequence(arguments.folder, arguments.options());
  print_warnings(sequence.report.warnings);
  const auto progress = make_progress(common);
  const std::int64_t unreadable = count_unreadable(sequence, *progress);
  check_recording(sequence, *progress);
  fmt::print("{}", common.json ? format_sequence_json(sequence, unreadable)
                               : format_sequence_text(sequence, unreadable));
  return 0;
}

}  // namespace cairn::app
