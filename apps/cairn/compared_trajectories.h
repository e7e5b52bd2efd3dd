// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/sequence/trajectory.h"
#include "pose_arguments.h"

namespace cairn::app {

struct ComparedPaths {
  std::vector<std::string> estimates;
  std::string reference;
  std::string camera;  ///< as --camera has it, where the reference is a sequence
  StampOffset offset;  ///< added to the estimates' stamps
};

/// Estimates and a reference with stamps by which they pair.
struct ComparedTrajectories {
  std::vector<Trajectory> estimates;
  /// Of each pose of each estimate the stamp in its file, nanoseconds; of files without times numbers of
  /// frames, or positions, as seconds.
  std::vector<std::vector<std::int64_t>> file_stamps_ns;
  Trajectory reference;
  /// What makes the first stamps of an estimate's file and of the reference's agree if it is added to the
  /// estimate's, whatever --offset says.
  std::vector<std::int64_t> start_offsets_ns;
  bool has_times = true;  ///< false: no file says a time, and stamps are positions or numbers, as seconds
};

/// Reads trajectories of any format (docs/poses.md), of runs, and a sequence's truth as the reference. Files
/// of KITTI pair by position: with the frames of a sequence, else with a file of as many poses. Geodetic
/// estimates get the reference's origin. Prints warnings. InputError for whatever is wrong.
[[nodiscard]] ComparedTrajectories read_compared(const ComparedPaths& paths);

}  // namespace cairn::app
