// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cairn/image/image.h"

namespace cairn {

/// Red, green, blue before rounding, 0 to 255.
using Color = Eigen::Vector3f;

/// Holds a picture that is laid on a surface, with the pyramid of its halves, so that it is filtered and not
/// aliased if seen from afar. Immutable; safe to sample from several threads.
class Texture {
 public:
  explicit Texture(const RgbImage& picture);

  /// Holds a pixel in four bytes, so that its channels are computed side by side.
  struct Texel {
    std::uint8_t r = 0, g = 0, b = 0, unused = 0;
  };

  [[nodiscard]] int width() const { return levels_.front().width(); }
  [[nodiscard]] int height() const { return levels_.front().height(); }

  /// Computes the mean colour over the parallelogram spanned by `step_x` and `step_y` (what one pixel sees)
  /// about `position`, all in pixels of the picture, (0, 0) the centre of its first pixel. Beyond its border
  /// the picture repeats the border's pixels. Long footprints are split into up to 8 probes along their long
  /// side (McCormack et al., "Feline", 1999), each trilinear.
  [[nodiscard]] Color sample(const Eigen::Vector2d& position, const Eigen::Vector2d& step_x,
                             const Eigen::Vector2d& step_y) const;

 private:
  std::vector<Image<Texel>> levels_;
};

}  // namespace cairn
