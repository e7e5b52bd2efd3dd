// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"

namespace cairn {

/// Returns the camera of the images that resize_image makes of those of `camera`. The areas of the pixels
/// stay aligned: with s = width / camera.width, fx becomes s fx and cx becomes s (cx + 1/2) - 1/2; with s =
/// height / camera.height, fy becomes s fy and cy becomes s (cy + 1/2) - 1/2. The distortion acts on rays and
/// stays. Throws PreconditionError unless both sizes are above 0.
[[nodiscard]] Camera resized_camera(const Camera& camera, int width, int height);

/// Resizes an image. Along a side that shrinks, a pixel is the mean of the area that it covers; along one
/// that grows, it is interpolated linearly between the centres of the nearest two. Gives the same bits on
/// every processor. Throws PreconditionError unless all sizes are above 0.
[[nodiscard]] GrayImage resize_image(const GrayImage& image, int width, int height);

/// Resizes a depth image: takes the pixel at each centre, since the mean of two surfaces lies on neither.
/// Throws PreconditionError unless all sizes are above 0.
[[nodiscard]] DepthImage resize_depth(const DepthImage& depth, int width, int height);

}  // namespace cairn
