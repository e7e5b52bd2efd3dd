// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/raster.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::uint8_t blend(std::uint8_t below, std::uint8_t above, double share) {
  return static_cast<std::uint8_t>(std::lround(below + share * (above - below)));
}

void blend(Rgb8& pixel, const Rgb8& color, double share) {
  pixel = {blend(pixel.r, color.r, share), blend(pixel.g, color.g, share), blend(pixel.b, color.b, share)};
}

/// The stroke covers a pixel by as much as the pixel's centre is nearer than half a width and half a pixel.
double coverage(double distance, double width) {
  return std::clamp(width / 2 + 0.5 - distance, 0.0, 1.0);
}

/// First and last pixel along one axis that a stroke from `low` to `high` can touch; false where there is
/// none.
bool clip(double low, double high, double reach, int size, int& first, int& last) {
  if (!(high + reach >= 0) || !(low - reach <= size - 1)) return false;  // not for NaN either
  first = static_cast<int>(std::max(0.0, std::floor(low - reach)));
  last = static_cast<int>(std::min(size - 1.0, std::ceil(high + reach)));
  return true;
}

}  // namespace

void draw_line(RgbImage& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Rgb8& color,
               double width) {
  const Eigen::Vector2d way = to - from;
  const double squared_length = way.squaredNorm(), reach = width / 2 + 1;
  int first_v = 0, last_v = 0;
  if (!clip(std::min(from.y(), to.y()), std::max(from.y(), to.y()), reach, image.height(), first_v, last_v))
    return;
  for (int v = first_v; v <= last_v; ++v) {
    // Only the part of the line that is near this row; all of it where it is level.
    double begin = 0, end = 1;
    if (std::abs(way.y()) > 1e-9) {
      const double a = (v - reach - from.y()) / way.y(), b = (v + reach - from.y()) / way.y();
      begin = std::clamp(std::min(a, b), 0.0, 1.0);
      end = std::clamp(std::max(a, b), 0.0, 1.0);
    }
    const double u0 = from.x() + begin * way.x(), u1 = from.x() + end * way.x();
    int first_u = 0, last_u = 0;
    if (!clip(std::min(u0, u1), std::max(u0, u1), reach, image.width(), first_u, last_u)) continue;
    for (int u = first_u; u <= last_u; ++u) {
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - from;
      const double along = squared_length > 0 ? std::clamp(offset.dot(way) / squared_length, 0.0, 1.0) : 0;
      blend(image(u, v), color, coverage((offset - along * way).norm(), width));
    }
  }
}

void draw_circle(RgbImage& image, const Eigen::Vector2d& center, double radius, const Rgb8& color,
                 double width) {
  const double reach = radius + width / 2 + 1;
  int first_u = 0, last_u = 0, first_v = 0, last_v = 0;
  if (!clip(center.x(), center.x(), reach, image.width(), first_u, last_u) ||
      !clip(center.y(), center.y(), reach, image.height(), first_v, last_v))
    return;
  for (int v = first_v; v <= last_v; ++v) {
    for (int u = first_u; u <= last_u; ++u) {
      const double distance = std::abs((Eigen::Vector2d(u, v) - center).norm() - radius);
      blend(image(u, v), color, coverage(distance, width));
    }
  }
}

void fill_circle(RgbImage& image, const Eigen::Vector2d& center, double radius, const Rgb8& color) {
  draw_circle(image, center, radius / 2, color, radius);  // a stroke that meets itself in the middle
}

void fill_rectangle(RgbImage& image, const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                    const Rgb8& color) {
  const int left = std::max(0, static_cast<int>(std::lround(corner.x())));
  const int top = std::max(0, static_cast<int>(std::lround(corner.y())));
  const int right = std::min(image.width(), static_cast<int>(std::lround(corner.x() + size.x())));
  const int bottom = std::min(image.height(), static_cast<int>(std::lround(corner.y() + size.y())));
  for (int v = top; v < bottom; ++v)
    for (int u = left; u < right; ++u) image(u, v) = color;
}

Rgb8 mix(const Rgb8& a, const Rgb8& b, double share) {
  Rgb8 mixed = a;
  blend(mixed, b, share);
  return mixed;
}

Rgb8 color_of_hue(double hue) {
  const auto channel = [hue](double peak) {
    const double away = std::abs(std::remainder(hue - peak, 1.0));  // [0, 0.5]
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(2 - 6 * away, 0.0, 1.0)));
  };
  return {channel(0), channel(1.0 / 3), channel(2.0 / 3)};
}

void paste_dimmed(RgbImage& picture, const GrayImage& image, int left) {
  constexpr double kDim = 0.75;
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const auto value = static_cast<std::uint8_t>(kDim * image(u, v));
      picture(left + u, v) = {value, value, value};
    }
  }
}

}  // namespace cairn
