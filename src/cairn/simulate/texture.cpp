// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/texture.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

constexpr int kMaxProbes = 8;

using Texel = Texture::Texel;
using Level = Image<Texel>;
using Channels = Eigen::Array4f;  // red, green, blue and nothing: one register

std::uint8_t mean_of_four(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}

Level halved(const Level& image) {
  Level half((image.width() + 1) / 2, (image.height() + 1) / 2);
  for (int v = 0; v < half.height(); ++v) {
    const Texel* top = image.row(2 * v);
    const Texel* bottom = image.row(std::min(2 * v + 1, image.height() - 1));
    for (int u = 0; u < half.width(); ++u) {
      const int left = 2 * u, right = std::min(2 * u + 1, image.width() - 1);
      const Texel &a = top[left], &b = top[right], &c = bottom[left], &d = bottom[right];
      half(u, v) = {mean_of_four(a.r, b.r, c.r, d.r), mean_of_four(a.g, b.g, c.g, d.g),
                    mean_of_four(a.b, b.b, c.b, d.b)};
    }
  }
  return half;
}

Channels to_channels(const Texel& p) {
  return {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b),
          static_cast<float>(p.unused)};
}

/// Samples one level of a pyramid at positions in pixels of its finest.
class BilinearSampler {
 public:
  BilinearSampler(const std::vector<Level>& levels, int level)
      : image_(&levels[static_cast<std::size_t>(level)]),
        scale_(1.0 / (1 << level)),
        last_u_(image_->width() - 1),
        last_v_(image_->height() - 1) {}

  [[nodiscard]] Channels operator()(double u, double v) const {
    const double x = std::clamp((u + 0.5) * scale_ - 0.5, 0.0, static_cast<double>(last_u_));
    const double y = std::clamp((v + 0.5) * scale_ - 0.5, 0.0, static_cast<double>(last_v_));
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const int right = std::min(left + 1, last_u_);
    const Channels fx = Channels::Constant(static_cast<float>(x - left));
    const Channels fy = Channels::Constant(static_cast<float>(y - top));
    const Channels rest = 1 - fx;
    const Texel* upper = image_->row(top);
    const Texel* lower = image_->row(std::min(top + 1, last_v_));
    const Channels above = to_channels(upper[left]) * rest + to_channels(upper[right]) * fx;
    const Channels below = to_channels(lower[left]) * rest + to_channels(lower[right]) * fx;
    return above + fy * (below - above);
  }

 private:
  const Level* image_;
  double scale_;
  int last_u_, last_v_;
};

/// Samples between the two levels about a fractional one.
class TrilinearSampler {
 public:
  TrilinearSampler(const std::vector<Level>& levels, double level)
      : finest_(std::min(static_cast<int>(level), static_cast<int>(levels.size()) - 1)),
        share_(static_cast<float>(level - finest_)),
        is_between_(share_ >= 0.01F && finest_ + 1 < static_cast<int>(levels.size())),
        fine_(levels, finest_),
        coarse_(levels, is_between_ ? finest_ + 1 : finest_) {}

  [[nodiscard]] Channels operator()(double u, double v) const {
    Channels color = fine_(u, v);
    if (!is_between_) return color;
    return color + Channels::Constant(share_) * (coarse_(u, v) - color);
  }

 private:
  int finest_;
  float share_;
  bool is_between_;
  BilinearSampler fine_, coarse_;
};

}  // namespace

Texture::Texture(const RgbImage& picture) {
  require(!picture.empty(), "a texture has a picture");
  Level& finest = levels_.emplace_back(picture.width(), picture.height());
  std::transform(picture.data(), picture.data() + picture.size(), finest.data(), [](const Rgb8& p) {
    return Texel{p.r, p.g, p.b};
  });
  while (levels_.back().width() > 1 || levels_.back().height() > 1) levels_.push_back(halved(levels_.back()));
}

Color Texture::sample(const Eigen::Vector2d& position, const Eigen::Vector2d& step_x,
                      const Eigen::Vector2d& step_y) const {
  const double length_x = step_x.norm(), length_y = step_y.norm();
  const Eigen::Vector2d& major = length_x > length_y ? step_x : step_y;
  const double longer = std::max(length_x, length_y);
  const double shorter = std::max(std::min(length_x, length_y), 1e-9);
  const int probes = longer <= 1.0 ? 1 : std::clamp(static_cast<int>(longer / shorter + 0.5), 1, kMaxProbes);
  const TrilinearSampler sampler(levels_, std::log2(std::max(longer / probes, 1.0)));
  if (probes == 1) return sampler(position.x(), position.y()).head<3>();
  Channels sum = Channels::Zero();
  for (int i = 0; i < probes; ++i) {
    const double offset = (i + 0.5) / probes - 0.5;
    sum += sampler(position.x() + offset * major.x(), position.y() + offset * major.y());
  }
  return sum.head<3>() / static_cast<float>(probes);
}

}  // namespace cairn
