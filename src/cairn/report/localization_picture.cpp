// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/localization_picture.h"

#include "cairn/report/raster.h"

namespace cairn {

RgbImage draw_localization(const GrayImage& image, const std::vector<DrawnMatch>& matches) {
  constexpr Rgb8 kInlier{64, 220, 96}, kOutlier{240, 72, 64}, kLandmark{255, 255, 255};
  constexpr double kFeatureRadius = 4, kDotRadius = 1;
  RgbImage picture(image.width(), image.height());
  paste_dimmed(picture, image, 0);
  for (const DrawnMatch& match : matches) {
    const Rgb8& color = match.inlier ? kInlier : kOutlier;
    draw_line(picture, match.seen, match.projected, color);
    draw_circle(picture, match.seen, kFeatureRadius, color);
    draw_circle(picture, match.projected, kDotRadius, kLandmark);
  }
  return picture;
}

}  // namespace cairn
