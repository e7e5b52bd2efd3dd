// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_layer.h"

#include <algorithm>
#include <cmath>

#include "cairn/report/colors.h"
#include "cairn/report/raster.h"

namespace cairn {
namespace {

/// Returns the share of the background that so many dots cover.
double cover(double dots) {
  constexpr double kTransparency = 0.4;
  return 1 - std::pow(kTransparency, dots);
}

}  // namespace

LandmarkLayer::LandmarkLayer(int width, int height, std::uint64_t landmarks) : sums_(width, height) {
  constexpr double kShareOfDistance = 0.22, kLeast = 1.0, kMost = 2.4;  // pixels
  const double area = static_cast<double>(width) * height;
  const double distance = std::sqrt(area / static_cast<double>(std::max<std::uint64_t>(landmarks, 1)));
  radius_ = std::clamp(kShareOfDistance * distance, kLeast, kMost);
}

void LandmarkLayer::add(const Eigen::Vector2d& pixel, double std) {
  const bool known = !std::isnan(std);
  (known ? has_known_ : has_unknown_) = true;
  const double reach = radius_ + 0.5;
  if (!(pixel.x() > -reach && pixel.y() > -reach && pixel.x() < sums_.width() - 1 + reach &&
        pixel.y() < sums_.height() - 1 + reach))
    return;
  const auto share = static_cast<float>(known ? std_share(std) : 0.0);
  const int first_u = std::max(0, static_cast<int>(std::ceil(pixel.x() - reach)));
  const int last_u = std::min(sums_.width() - 1, static_cast<int>(std::floor(pixel.x() + reach)));
  const int first_v = std::max(0, static_cast<int>(std::ceil(pixel.y() - reach)));
  const int last_v = std::min(sums_.height() - 1, static_cast<int>(std::floor(pixel.y() + reach)));
  for (int v = first_v; v <= last_v; ++v) {
    for (int u = first_u; u <= last_u; ++u) {
      const double distance = (Eigen::Vector2d(u, v) - pixel).norm();
      const auto covered = static_cast<float>(std::clamp(reach - distance, 0.0, 1.0));
      Sum& sum = sums_(u, v);
      sum.dots += covered;
      if (!known) continue;
      sum.known += covered;
      sum.known_share += covered * share;
    }
  }
}

void LandmarkLayer::draw(RgbImage& picture) const {
  for (int v = 0; v < sums_.height(); ++v) {
    for (int u = 0; u < sums_.width(); ++u) {
      const Sum& sum = sums_(u, v);
      if (sum.dots == 0) continue;
      const Rgb8 color =
          sum.known > 0 ? error_rgb(static_cast<double>(sum.known_share / sum.known)) : kUnknownStd;
      picture(u, v) = mix(picture(u, v), color, cover(static_cast<double>(sum.dots)));
    }
  }
}

void LandmarkLayer::draw(RgbImage& picture, const Rgb8& color) const {
  for (int v = 0; v < sums_.height(); ++v)
    for (int u = 0; u < sums_.width(); ++u)
      picture(u, v) = mix(picture(u, v), color, cover(static_cast<double>(sums_(u, v).dots)));
}

}  // namespace cairn
