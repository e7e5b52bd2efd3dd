// SPDX-License-Identifier: Apache-2.0
// A wall that is known at every point, and what cameras see of it.
#pragma once

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn::testkit {

/// Returns the grey level of a wall 3 m ahead of the world's origin, x right, y down; smooth, so that
/// interpolation is nearly exact.
[[nodiscard]] double wall_level(double x, double y);

/// Returns the wall as a camera sees it; black if a pixel has no ray to it.
[[nodiscard]] GrayImage see_wall(const Camera& camera, const Rigid3& world_from_camera);

/// Returns the largest difference of two images of one size, grey levels.
[[nodiscard]] int largest_difference(const GrayImage& a, const GrayImage& b);

}  // namespace cairn::testkit
