// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"

namespace cairn {

PixelRays::PixelRays(const Camera& camera) : width_(camera.width), height_(camera.height) {
  require(width_ > 0 && height_ > 0, "a camera has pixels");
  const std::size_t count = offset(height_);
  x_.assign(count, std::numeric_limits<double>::quiet_NaN());
  y_ = x_;
  std::size_t i = 0;
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u, ++i) {
      const auto ray = camera.unproject({u, v});
      if (!ray) continue;
      x_[i] = ray->x();
      y_[i] = ray->y();
      max_length_ = std::max(max_length_, std::sqrt(1.0 + ray->squaredNorm()));
    }
  }
}

}  // namespace cairn
