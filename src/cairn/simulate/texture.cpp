// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

constexpr int kMaxProbes = 8;

std::uint8_t mean_of_four(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}

RgbImage halved(const RgbImage& image) {
  RgbImage half((image.width() + 1) / 2, (image.height() + 1) / 2);
  for (int v = 0; v < half.height(); ++v) {
    const Rgb8* top = image.row(2 * v);
    const Rgb8* bottom = image.row(std::min(2 * v + 1, image.height() - 1));
    for (int u = 0; u < half.width(); ++u) {
      const int left = 2 * u, right = std::min(2 * u + 1, image.width() - 1);
      const Rgb8 &a = top[left], &b = top[right], &c = bottom[left], &d = bottom[right];
      half(u, v) = {mean_of_four(a.r, b.r, c.r, d.r), mean_of_four(a.g, b.g, c.g, d.g),
                    mean_of_four(a.b, b.b, c.b, d.b)};
    }
  }
  return half;
}

Color to_color(const Rgb8& p) {
  return {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
}

}  // namespace

Texture::Texture(RgbImage picture) {
  require(!picture.empty(), "a texture has a picture");
  levels_.push_back(std::move(picture));
  while (levels_.back().width() > 1 || levels_.back().height() > 1) levels_.push_back(halved(levels_.back()));
}

Color Texture::sample(const Eigen::Vector2d& position, const Eigen::Vector2d& step_x,
                      const Eigen::Vector2d& step_y) const {
  const double length_x = step_x.norm(), length_y = step_y.norm();
  const Eigen::Vector2d& major = length_x > length_y ? step_x : step_y;
  const double longer = std::max(length_x, length_y);
  const double shorter = std::max(std::min(length_x, length_y), 1e-9);
  const int probes = longer <= 1.0 ? 1 : std::clamp(static_cast<int>(longer / shorter + 0.5), 1, kMaxProbes);
  const double level = std::log2(std::max(longer / probes, 1.0));
  if (probes == 1) return sample_trilinear(position, level);
  Color sum = Color::Zero();
  for (int i = 0; i < probes; ++i) {
    const double offset = (i + 0.5) / probes - 0.5;
    sum += sample_trilinear(position + offset * major, level);
  }
  return sum / static_cast<float>(probes);
}

Color Texture::sample_trilinear(const Eigen::Vector2d& position, double level) const {
  const int last = static_cast<int>(levels_.size()) - 1;
  const int fine = std::min(static_cast<int>(level), last);
  const float share = static_cast<float>(level - fine);
  Color color = sample_bilinear(position, fine);
  if (share < 0.01F || fine == last) return color;
  return color + share * (sample_bilinear(position, fine + 1) - color);
}

Color Texture::sample_bilinear(const Eigen::Vector2d& position, int level) const {
  const RgbImage& image = levels_[static_cast<std::size_t>(level)];
  const double scale = 1.0 / (1 << level);
  const double x = std::clamp((position.x() + 0.5) * scale - 0.5, 0.0, image.width() - 1.0);
  const double y = std::clamp((position.y() + 0.5) * scale - 0.5, 0.0, image.height() - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, image.width() - 1);
  const float fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
  const Rgb8* upper = image.row(top);
  const Rgb8* lower = image.row(std::min(top + 1, image.height() - 1));
  const Color above = to_color(upper[left]) * (1 - fx) + to_color(upper[right]) * fx;
  const Color below = to_color(lower[left]) * (1 - fx) + to_color(lower[right]) * fx;
  return above + fy * (below - above);
}

}  // namespace cairn
