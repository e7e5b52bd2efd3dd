// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/simulate/scene_builder.h"

namespace cairn {

/// Width (x), depth (y) and height (z) of the simulated room, metres; a corner of its floor is (0, 0, 0).
inline const Eigen::Vector3d kRoomSize{6.0, 5.0, 2.6};

/// Builds walls, floor, ceiling and furniture; the furniture stands along the walls and leaves the middle
/// free.
[[nodiscard]] SceneBuilder furnished_room(double texel, std::uint64_t seed);

}  // namespace cairn
