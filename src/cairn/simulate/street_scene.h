// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "cairn/simulate/scene_builder.h"

namespace cairn {

/// Builds a street around a block of houses, for a drive along the rectangle with `half_extent` (metres, x
/// and y) about the origin, anticlockwise, on the right: houses inside and outside, pavements, parked cars,
/// poles, trees. The ground is z = 0.
[[nodiscard]] SceneBuilder street_around_block(const Eigen::Vector2d& half_extent, double texel,
                                               std::uint64_t seed);

}  // namespace cairn
