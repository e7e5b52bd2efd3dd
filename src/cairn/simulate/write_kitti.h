// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/sequence/sequence.h"
#include "cairn/simulate/simulate_street.h"
#include "cairn/simulate/simulation_writer.h"

namespace cairn {

// The layout of the KITTI odometry benchmark (Geiger et al. 2012), into a folder that exists: image_0 (left)
// and image_1 (right), calib.txt, times.txt, poses.txt (3x4 world_from_camera by rows, of the left camera).
// InputError where the disk refuses.

/// Writes a simulated street. With `depth_truth` the left camera's true depth in a folder of that name, 16
/// bit, 256 units per metre, 0 where there is none.
SimulationReport write_kitti(const SimulatedStreet& street, const std::filesystem::path& folder,
                             bool depth_truth, const Executor& executor, Progress& progress);

/// What was written of a stereo sequence.
struct RectifiedReport {
  int frames = 0;          ///< fewer than the sequence has where the user stopped or some cannot be read
  int unreadable = 0;      ///< left out, each with a warning; their numbers are missing in the file names
  bool has_poses = false;  ///< every one of them has a true pose
  bool stopped = false;
};

/// Writes a stereo sequence as FrameLoader gives it, rectified and grey; poses.txt where every frame has a
/// true pose. Pairs that cannot be read are left out. InputError for a sequence that is not stereo and where
/// no pair can be read.
RectifiedReport write_rectified(const Sequence& sequence, const std::filesystem::path& folder,
                                const Executor& executor, Progress& progress);

}  // namespace cairn
