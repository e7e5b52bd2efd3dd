// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>

#include "cairn/core/executor.h"
#include "cairn/geometry/camera.h"
#include "cairn/image/image.h"

namespace cairn {

/// Remaps images of one camera to those that another one at the same position, possibly rotated, would have
/// taken, or by a given function: for undistortion and rectification. The source of each pixel is computed
/// once, to 1/256 pixel; images are interpolated bilinearly in integers. Gives the same bits at any number of
/// threads and on every processor. Safe to call from several threads.
class ImageRemap {
 public:
  /// Computes the sources; `source_from_target` rotates the target's rays into the source's frame.
  ImageRemap(const Camera& source, const Camera& target, const Eigen::Quaterniond& source_from_target,
             const Executor& executor = Executor());

  /// Computes the sources by a function of the target's pixel, which returns nullopt for a pixel without one.
  ImageRemap(const ImageSize& source, const ImageSize& target,
             const std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>& source_of,
             const Executor& executor = Executor());

  /// Remaps a grey image; pixels that the source camera does not see are black. Throws PreconditionError
  /// unless `image` has the source camera's size.
  [[nodiscard]] GrayImage operator()(const GrayImage& image, const Executor& executor = Executor()) const;
  /// Remaps a colour image; pixels that the source camera does not see are black. Throws PreconditionError
  /// unless `image` has the source camera's size.
  [[nodiscard]] RgbImage operator()(const RgbImage& image, const Executor& executor = Executor()) const;

  /// Tells whether the source camera sees a pixel of the target: up to half a pixel beyond the centres of its
  /// outermost pixels.
  [[nodiscard]] bool sees(int u, int v) const { return origins_(u, v).offset >= 0; }

 private:
  /// Holds the upper left of four source pixels, and the share (of 256) of those to the right and below.
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
