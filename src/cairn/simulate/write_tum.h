// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/simulate/simulate_room.h"
#include "cairn/simulate/simulation_writer.h"

namespace cairn {

/// Writes a simulated room into a folder that exists, in the layout of the TUM RGB-D benchmark (Sturm et al.
/// 2012): rgb.txt, depth.txt, associations.txt, groundtruth.txt (world_from_camera), rgb/ and depth/ named by
/// their stamps, and camera.yaml. With `depth_truth`, also the true depth in a folder of that name, with the
/// names of the colour images and in the units of the depth images, 0 if unknown. With errors of poses, also
/// given_poses.txt: the poses with these and their standard deviations, a table (docs/poses.md). Throws
/// InputError if the disk fails.
SimulationReport write_tum(const SimulatedRoom& room, const std::filesystem::path& folder,
                           const Executor& executor, Progress& progress, bool depth_truth = false);

}  // namespace cairn
