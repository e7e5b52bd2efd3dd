// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/sequence/given_poses.h"
#include "command_line.h"

namespace cairn::app {

/// What is added to stamps: seconds, or "start": what makes the first stamps agree.
struct StampOffset {
  std::string text = "0";
  [[nodiscard]] bool is_start() const { return text == "start"; }
  [[nodiscard]] double seconds() const;  ///< 0 for "start"
};
/// An option that takes a StampOffset; `what` says whose stamps it is added to.
void add_stamp_offset(CommandLine& app, const std::string& name, const std::string& what,
                      StampOffset& offset);

/// --poses, --pose-offset, --pose-gap for whatever takes poses that are known.
struct PoseArguments {
  std::string path;
  StampOffset time_offset;
  double max_gap_s = GivenPosesOptions{}.max_gap_s;

  [[nodiscard]] GivenPosesOptions options() const;
};

void add_pose_options(CommandLine& app, PoseArguments& arguments);
/// --pose-offset and --pose-gap alone.
void add_pose_time_options(CommandLine& app, PoseArguments& arguments);

/// The poses without what is known of them; prints their warnings.
[[nodiscard]] std::vector<std::optional<WorldFromCamera>> read_reported_poses(const Sequence& sequence,
                                                                              const PoseArguments& arguments);

}  // namespace cairn::app
