// SPDX-License-Identifier: Apache-2.0
#include "pose_arguments.h"

#include "cairn/core/text.h"
#include "common.h"

namespace cairn::app {

namespace {

constexpr double kLongest = 9e9;  // seconds

}  // namespace

double StampOffset::seconds() const {
  double value = 0;
  return parse_number(text, value) ? value : 0;
}

void add_stamp_offset(CommandLine& app, const std::string& name, const std::string& what,
                      StampOffset& offset) {
  app.add_option(name, offset.text,
                 "seconds to add to the stamps of " + what + "; start: so that the first stamps agree")
      .type_name("S|start")
      .check(number_in_or(-kLongest, kLongest, "start"))
      .show_default();
}

GivenPosesOptions PoseArguments::options() const {
  GivenPosesOptions options;
  options.path = path;
  options.time_offset_s = time_offset.seconds();
  options.align_first_stamps = time_offset.is_start();
  options.max_gap_s = max_gap_s;
  return options;
}

void add_pose_options(CommandLine& app, PoseArguments& arguments) {
  app.add_option(
         "--poses", arguments.path,
         "poses: TUM, KITTI, EuRoC, OXTS packets or a table, docs/poses.md (default: the sequence's own)")
      .type_name("FILE");
  add_pose_time_options(app, arguments);
}

void add_pose_time_options(CommandLine& app, PoseArguments& arguments) {
  add_stamp_offset(app, "--pose-offset", "the poses", arguments.time_offset);
  app.add_option("--pose-gap", arguments.max_gap_s,
                 "seconds; between two poses further apart a frame gets none")
      .type_name("S")
      .check(number_in(0, kLongest))
      .show_default();
}

std::vector<std::optional<WorldFromCamera>> read_reported_poses(const Sequence& sequence,
                                                                const PoseArguments& arguments) {
  const GivenPoses given = read_given_poses(sequence, arguments.options());
  print_warnings(given.warnings);
  return camera_poses(given);
}

}  // namespace cairn::app
