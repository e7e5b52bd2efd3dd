// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cairn/sequence/given_poses.h"

namespace cairn::app {

/// --poses, --pose-offset, --pose-gap for whatever takes poses that are known.
struct PoseArguments {
  std::string path;
  double time_offset_s = GivenPosesOptions{}.time_offset_s;
  double max_gap_s = GivenPosesOptions{}.max_gap_s;

  [[nodiscard]] GivenPosesOptions options() const;
};

void add_pose_options(CLI::App& app, PoseArguments& arguments);

}  // namespace cairn::app
