// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/dense/occupancy.h"

namespace octomap {
class OcTree;
}

namespace cairn::testkit {

/// Returns the map of ten depth images from a camera on its way (depth_image, walking_pose).
[[nodiscard]] OccupancyGrid map_scene(int threads, bool colored = true);

/// Returns OctoMap's own map of the same points, none of its nodes pruned.
[[nodiscard]] std::unique_ptr<octomap::OcTree> map_scene_with_octomap();

}  // namespace cairn::testkit
