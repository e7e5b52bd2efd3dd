// SPDX-License-Identifier: Apache-2.0
// What an RGB-D camera of 64 x 48 pixels sees on its way.
#pragma once

#include <cstdint>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/image/image.h"

namespace cairn::testkit {

/// Returns the camera of the images below.
[[nodiscard]] Camera small_camera();

/// Returns depths, in metres, of a wall 2 m ahead with a box before it, holes, and a far corner beyond 4 m;
/// with noise.
[[nodiscard]] DepthImage depth_image(std::uint64_t seed);

/// Returns an image whose colours tell its pixels apart.
[[nodiscard]] RgbImage color_image();

/// Returns world_from_camera of a camera that turns and walks.
[[nodiscard]] Rigid3 walking_pose(int frame);

}  // namespace cairn::testkit
