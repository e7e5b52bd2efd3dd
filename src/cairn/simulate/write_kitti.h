// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/sequence/sequence.h"
#include "cairn/simulate/simulate_street.h"
#include "cairn/simulate/simulation_writer.h"

namespace cairn {

// The layout of the KITTI odometry benchmark (Geiger et al. 2012), into a folder that exists: image_0 (left)
// and image_1 (right), calib.txt, times.txt, poses.txt (3x4 world_from_camera by rows, of the left camera).
// Throws InputError if the disk fails.

/// Writes a simulated street. With `depth_truth`, also the left camera's true depth in a folder of that name,
/// 16 bit, 256 units per metre, 0 if unknown. With poses of the body, also body_poses.csv in EuRoC's layout
/// and a camera.yaml that states where the camera sits on the body. With errors of poses, also the poses with
/// these and their standard deviations, as a table (docs/poses.md): given_poses.txt of the camera or, with
/// poses of the body, given_body_poses.csv of that.
SimulationReport write_kitti(const SimulatedStreet& street, const std::filesystem::path& folder,
                             bool depth_truth, const Executor& executor, Progress& progress);

/// Describes what was written of a stereo sequence.
struct RectifiedReport {
  int frames = 0;          ///< fewer than the sequence has if the user stopped or some cannot be read
  int unreadable = 0;      ///< left out, each with a warning; their numbers are missing in the file names
  bool has_poses = false;  ///< every frame written has a true pose
  bool stopped = false;
};

/// Writes a stereo sequence as FrameLoader gives it, rectified and grey; poses.txt if every frame has a true
/// pose; camera.yaml if the calibration corrects disparities, which the images do not show. Leaves out pairs
/// that cannot be read. Throws InputError if the sequence is not stereo or no pair can be read.
RectifiedReport write_rectified(const Sequence& sequence, const std::filesystem::path& folder,
                                const Executor& executor, Progress& progress);

}  // namespace cairn
