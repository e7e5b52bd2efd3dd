// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "cairn/image/image.h"

namespace cairn {

/// Landmarks as dots in a picture. Where many lie above one another they cover the background better, and
/// their colour is that of the mean of their std_share; memory does not grow with their number.
class LandmarkLayer {
 public:
  /// The radius of a dot is chosen so that `landmarks` of them do not fill the picture.
  LandmarkLayer(int width, int height, std::uint64_t landmarks);

  /// `pixel` may lie outside; `std` in metres, NaN if it is not known.
  void add(const Eigen::Vector2d& pixel, double std);
  /// Whether the standard deviation of any landmark was known, or not known.
  [[nodiscard]] bool has_known() const { return has_known_; }
  [[nodiscard]] bool has_unknown() const { return has_unknown_; }

  /// Draws the dots in the colours of std_rgb.
  void draw(RgbImage& picture) const;
  /// Draws all dots in one colour.
  void draw(RgbImage& picture, const Rgb8& color) const;

 private:
  struct Sum {
    float dots = 0;         // coverage, of all
    float known = 0;        // of those whose std is known
    float known_share = 0;  // their std_share times coverage
  };
  Image<Sum> sums_;
  double radius_;
  bool has_known_ = false, has_unknown_ = false;
};

}  // namespace cairn
