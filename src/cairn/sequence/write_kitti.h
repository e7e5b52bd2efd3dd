// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/sequence/simulate_street.h"
#include "cairn/sequence/simulation_writer.h"

namespace cairn {

/// Writes a simulated street into a folder that exists, in the layout of the KITTI odometry benchmark (Geiger
/// et al. 2012): image_0 (left) and image_1 (right), calib.txt, times.txt, poses.txt (3x4 world_from_camera
/// by rows, of the left camera). With `depth_truth` the left camera's true depth in a folder of that name,
/// 16 bit, 256 units per metre, 0 where there is none. InputError where the disk refuses.
SimulationReport write_kitti(const SimulatedStreet& street, const std::filesystem::path& folder,
                             bool depth_truth, const Executor& executor, Progress& progress);

}  // namespace cairn
