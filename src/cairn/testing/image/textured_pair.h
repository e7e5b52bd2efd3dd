// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/image/image.h"

namespace cairn::testkit {

/// Defines a texture that is known between pixels, too: waves of at least `shortest_px` pixels.
class Waves {
 public:
  Waves(double shortest_px, double contrast, std::uint64_t seed);

  /// Returns the deviation from the mean grey level, whose standard deviation is the contrast.
  [[nodiscard]] double at(double x, double y) const;

 private:
  struct Wave {
    double x, y, phase, height;
  };
  std::vector<Wave> waves_;
};

/// Describes a surface whose disparity changes linearly from that in the middle of the image.
struct Surface {
  double at_centre = 0, slope_u = 0, slope_v = 0;

  [[nodiscard]] double disparity(const GrayImage& image, double u, double v) const {
    return at_centre + slope_u * (u - 0.5 * image.width()) + slope_v * (v - 0.5 * image.height());
  }
};

struct TestPair {
  GrayImage left, right;
};

/// Returns the nearest grey level.
[[nodiscard]] std::uint8_t to_gray(double level);

/// Returns what a stereo pair sees of the surface. The right camera's exposure is `gain` times the left
/// one's; both images have noise of `deviation` grey levels.
[[nodiscard]] TestPair make_pair(int width, int height, const Surface& surface, const Waves& waves,
                                 double gain, double deviation);

}  // namespace cairn::testkit
