// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"

namespace cairn {

/// Returns the camera of the images that resize_image makes of those of `camera`. The areas of the pixels
/// stay aligned: with s = width / camera.width, fx becomes s fx and cx becomes s (cx + 1/2) - 1/2, and so for
/// rows. The distortion acts on rays and stays. PreconditionError unless both sizes are above 0.
[[nodiscard]] Camera resized_camera(const Camera& camera, int width, int height);

/// Resizes an image. Along a side that shrinks, a pixel is the mean of the area that it covers; along one
/// that grows, it is interpolated linearly between the centres of the nearest two. The same bits on every
/// processor. PreconditionError unless all sizes are above 0.
[[nodiscard]] GrayImage resize_image(const GrayImage& image, int width, int height);

/// Resizes a depth image: each pixel is the one at its centre, as the mean of two surfaces is on neither.
[[nodiscard]] DepthImage resize_depth(const DepthImage& depth, int width, int height);

}  // namespace cairn
