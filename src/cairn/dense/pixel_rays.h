// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/geometry/camera.h"

namespace cairn {

/// Holds the rays (x/z, y/z) of all pixels of a camera, computed once: back-projecting a depth image is then
/// a multiplication per pixel, whatever the camera model. Pixels whose distortion has no inverse are NaN.
class PixelRays {
 public:
  explicit PixelRays(const Camera& camera);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Returns x/z of the pixels of row v.
  [[nodiscard]] const double* x_row(int v) const { return x_.data() + offset(v); }
  /// Returns y/z of the pixels of row v.
  [[nodiscard]] const double* y_row(int v) const { return y_.data() + offset(v); }
  /// Returns the largest length of (x/z, y/z, 1): depth times this bounds the distance from the camera.
  [[nodiscard]] double max_length() const { return max_length_; }

 private:
  [[nodiscard]] std::size_t offset(int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_);
  }

  int width_, height_;
  std::vector<double> x_, y_;
  double max_length_ = 1;
};

}  // namespace cairn
