// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"

namespace cairn {

/// Images of one camera as another one in the same place, which may be turned, would have taken them: for
/// undistortion and rectification. Where each pixel comes from is computed once, to 1/256 pixel; images are
/// interpolated bilinearly in integers. The same bits at any number of threads and on every processor. Safe
/// to call from several threads.
class ImageRemap {
 public:
  /// `source_from_target` turns the target's rays into the source's frame.
  ImageRemap(const Camera& source, const Camera& target, const Eigen::Quaterniond& source_from_target,
             const Executor& executor = Executor());

  /// Black where the source camera sees nothing. PreconditionError unless `image` has its size.
  [[nodiscard]] GrayImage operator()(const GrayImage& image, const Executor& executor = Executor()) const;
  [[nodiscard]] RgbImage operator()(const RgbImage& image, const Executor& executor = Executor()) const;

  /// True for a pixel of the target that the source camera sees: up to half a pixel beyond the centres of its
  /// outermost pixels.
  [[nodiscard]] bool sees(int u, int v) const { return origins_(u, v).offset >= 0; }

 private:
  /// The upper left of four source pixels, and the share (of 256) of those to the right and below.
  struct Origin {
    std::int32_t offset = -1;  // in pixels from the first; -1: nothing
    std::uint16_t right = 0, below = 0;
  };

  [[nodiscard]] Origin origin_of(const Eigen::Vector2d& pixel) const;
  template <class Pixel>
  [[nodiscard]] Image<Pixel> remap(const Image<Pixel>& image, const Executor& executor) const;

  int source_width_, source_height_;
  Image<Origin> origins_;
};

}  // namespace cairn
