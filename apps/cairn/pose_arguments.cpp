// SPDX-License-Identifier: Apache-2.0
#include "pose_arguments.h"

#include "common.h"

namespace cairn::app {

GivenPosesOptions PoseArguments::options() const {
  GivenPosesOptions options;
  options.path = path;
  options.time_offset_s = time_offset_s;
  options.max_gap_s = max_gap_s;
  return options;
}

void add_pose_options(CLI::App& app, PoseArguments& arguments) {
  constexpr double kLongest = 9e9;
  app.add_option(
         "--poses", arguments.path,
         "poses: TUM, KITTI, EuRoC, OXTS packets or a table, docs/poses.md (default: the sequence's own)")
      ->type_name("FILE");
  app.add_option("--pose-offset", arguments.time_offset_s, "seconds to add to the stamps of the poses")
      ->type_name("S")
      ->check(number_in(-kLongest, kLongest))
      ->capture_default_str();
  app.add_option("--pose-gap", arguments.max_gap_s,
                 "seconds; between two poses further apart a frame gets none")
      ->type_name("S")
      ->check(number_in(0, kLongest))
      ->capture_default_str();
}

}  // namespace cairn::app
