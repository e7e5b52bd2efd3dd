// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/feature_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/report/raster.h"

namespace cairn {
namespace {

constexpr double kBlue = 2.0 / 3;  // hue

Eigen::Vector2d place(const Keypoint& keypoint, double left = 0) {
  return {static_cast<double>(keypoint.u) + left, static_cast<double>(keypoint.v)};
}

struct SizeRange {
  double low = 0, high = 0;

  /// 0 for the smallest size, 1 for the largest, evenly over the scales between.
  [[nodiscard]] double share(double size) const {
    return high > low && low > 0 ? std::log(size / low) / std::log(high / low) : 0;
  }
};

SizeRange sizes_of(std::span<const Keypoint> keypoints) {
  const auto [low, high] =
      std::minmax_element(keypoints.begin(), keypoints.end(),
                          [](const Keypoint& a, const Keypoint& b) { return a.size < b.size; });
  return {static_cast<double>(low->size), static_cast<double>(high->size)};
}

}  // namespace

RgbImage draw_keypoints(const GrayImage& image, std::span<const Keypoint> keypoints) {
  RgbImage picture(image.width(), image.height());
  paste_dimmed(picture, image, 0);
  if (keypoints.empty()) return picture;
  constexpr double kRadiusPerSize = 0.15;  // the patch itself would hide the image
  constexpr double kMinRadius = 2;
  const SizeRange sizes = sizes_of(keypoints);
  for (const Keypoint& keypoint : keypoints) {
    const auto size = static_cast<double>(keypoint.size);
    const double radius = std::max(kMinRadius, kRadiusPerSize * size);
    const Rgb8 color = color_of_hue(kBlue * (1 - sizes.share(size)));
    draw_circle(picture, place(keypoint), radius, color);
    if (keypoint.angle_deg < 0) continue;
    const double angle = static_cast<double>(keypoint.angle_deg) * std::numbers::pi / 180;
    draw_line(picture, place(keypoint),
              place(keypoint) + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), color);
  }
  return picture;
}

RgbImage draw_matches(const GrayImage& first, std::span<const Keypoint> first_keypoints,
                      const GrayImage& second, std::span<const Keypoint> second_keypoints,
                      std::span<const Match> matches) {
  RgbImage picture(first.width() + second.width(), std::max(first.height(), second.height()));
  paste_dimmed(picture, first, 0);
  paste_dimmed(picture, second, first.width());
  constexpr double kDotRadius = 1.5, kLineWidth = 0.8;
  for (const Match& match : matches) {
    const Keypoint& from = first_keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& to = second_keypoints[static_cast<std::size_t>(match.train)];
    const Rgb8 color = color_of_hue(static_cast<double>(from.v) / std::max(1, first.height()) * kBlue);
    const Eigen::Vector2d end = place(to, first.width());
    draw_line(picture, place(from), end, color, kLineWidth);
    draw_circle(picture, place(from), kDotRadius, color);
    draw_circle(picture, end, kDotRadius, color);
  }
  return picture;
}

}  // namespace cairn
