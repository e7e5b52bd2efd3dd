// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/canvas.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

/// Uniform in [-1, 1) at the corners of a lattice.
float lattice_value(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t z = seed + static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL +
                    static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<float>(static_cast<std::int32_t>(z >> 32)) * 0x1.0p-31F;
}

float smooth_step(float t) {
  return t * t * (3 - 2 * t);
}

/// Adds one octave of value noise to a row of the field; the row lies at `y` cells.
void add_octave_row(float* row, int width, double y, double cells_per_texel, float amplitude,
                    std::uint64_t seed) {
  const auto cell_y = static_cast<std::int64_t>(y);
  const float fy = smooth_step(static_cast<float>(y - static_cast<double>(cell_y)));
  std::int64_t cell_x = -1;
  float left = 0, right = 0;
  for (int u = 0; u < width; ++u) {
    const double x = u * cells_per_texel;
    if (const auto here = static_cast<std::int64_t>(x); here != cell_x) {
      cell_x = here;
      const auto column = [&](std::int64_t i) {
        const float top = lattice_value(i, cell_y, seed);
        return top + fy * (lattice_value(i, cell_y + 1, seed) - top);
      };
      left = column(cell_x);
      right = column(cell_x + 1);
    }
    const float fx = smooth_step(static_cast<float>(x - static_cast<double>(cell_x)));
    row[u] += amplitude * (left + fx * (right - left));
  }
}

/// Amplitude of the first octave, so that all together have the deviation.
double first_amplitude(const NoiseStyle& style, float deviation) {
  double power = 0;
  for (int i = 0; i < style.octaves; ++i) power += std::pow(style.gain, 2 * i);
  constexpr double kUnitDeviation = 0.41;  // of interpolated uniform noise in [-1, 1)
  return deviation / (kUnitDeviation * std::sqrt(power));
}

Image<float> fractal_noise(int width, int height, double texel, const NoiseStyle& style, float deviation,
                           std::uint64_t seed) {
  Image<float> field(width, height);
  const double first = first_amplitude(style, deviation);
  for (int i = 0; i < style.octaves; ++i) {
    const double cells_per_texel = texel / style.cell * (1 << i);
    if (cells_per_texel > 0.5) break;
    const auto amplitude = static_cast<float>(first * std::pow(style.gain, i));
    for (int v = 0; v < height; ++v)
      add_octave_row(field.row(v), width, v * cells_per_texel, cells_per_texel, amplitude,
                     seed + static_cast<std::uint64_t>(i) * 0x51ed270b);
  }
  return field;
}

/// Which share of the light each texel of a line loses, by its distance from the nearer end.
std::vector<float> border_shares(int count, double texel, double share, double reach) {
  std::vector<float> lost(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double distance = (std::min(i, count - 1 - i) + 0.5) * texel;
    lost[static_cast<std::size_t>(i)] = static_cast<float>(share * std::exp(-distance / reach));
  }
  return lost;
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
}

void blend(Rgb8& pixel, const Color& color, float share) {
  const auto mix = [share](std::uint8_t old, float fresh) {
    const auto before = static_cast<float>(old);
    return to_byte(before + share * (fresh - before));
  };
  pixel = {mix(pixel.r, color[0]), mix(pixel.g, color[1]), mix(pixel.b, color[2])};
}

/// Metres outside of the shape, negative inside; `p` relative to its centre, turned into its axes.
double signed_distance(const Shape& shape, const Eigen::Vector2d& p) {
  if (shape.round) return (p.cwiseQuotient(shape.half).norm() - 1) * shape.half.minCoeff();
  return (p.cwiseAbs() - shape.half).maxCoeff();
}

int texels_for(double length, double texel) {
  return std::max(2, static_cast<int>(std::ceil(length / texel)));
}

}  // namespace

Canvas::Canvas(double width, double height, double texel, const Color& ground)
    : width_(width), height_(height) {
  require(width > 0 && height > 0 && texel > 0, "a canvas has a size");
  image_ = RgbImage(texels_for(width, texel), texels_for(height, texel),
                    {to_byte(ground[0]), to_byte(ground[1]), to_byte(ground[2])});
  texel_ = {width / image_.width(), height / image_.height()};
}

void Canvas::add_noise(const NoiseStyle& style, std::uint64_t seed) {
  const auto light = fractal_noise(image_.width(), image_.height(), texel_.x(), style, style.contrast, seed);
  NoiseStyle coarse = style;
  coarse.octaves = std::min(style.octaves, 3);
  const auto tint = fractal_noise(image_.width(), image_.height(), texel_.x(), coarse, style.tint, ~seed);
  for (std::size_t i = 0; i < image_.size(); ++i) {
    Rgb8& p = image_.data()[i];
    const float l = light.data()[i], t = tint.data()[i];
    p = {to_byte(static_cast<float>(p.r) + l + t), to_byte(static_cast<float>(p.g) + l),
         to_byte(static_cast<float>(p.b) + l - t)};
  }
}

void Canvas::fill(const Color& color) {
  const Rgb8 pixel{to_byte(color[0]), to_byte(color[1]), to_byte(color[2])};
  std::fill(image_.data(), image_.data() + image_.size(), pixel);
}

void Canvas::scale(float brightness) {
  const auto scaled = [=](std::uint8_t level) { return to_byte(static_cast<float>(level) * brightness); };
  for (std::size_t i = 0; i < image_.size(); ++i) {
    Rgb8& p = image_.data()[i];
    p = {scaled(p.r), scaled(p.g), scaled(p.b)};
  }
}

void Canvas::shade_borders(double share, double reach) {
  const auto columns = border_shares(image_.width(), texel_.x(), share, reach);
  const auto rows = border_shares(image_.height(), texel_.y(), share, reach);
  for (int v = 0; v < image_.height(); ++v) {
    for (int u = 0; u < image_.width(); ++u) {
      const float lost = columns[static_cast<std::size_t>(u)] + rows[static_cast<std::size_t>(v)];
      blend(image_(u, v), Color::Zero(), std::min(lost, 1.0F));
    }
  }
}

void Canvas::draw(const Shape& shape) {
  const double c = std::cos(shape.angle), s = std::sin(shape.angle);
  const Eigen::Vector2d reach(std::abs(c) * shape.half.x() + std::abs(s) * shape.half.y() + texel_.x(),
                              std::abs(s) * shape.half.x() + std::abs(c) * shape.half.y() + texel_.y());
  const auto first = [](double metres, double texel) {
    return std::max(0, static_cast<int>(metres / texel));
  };
  const int u_end = std::min(image_.width(), first(shape.center.x() + reach.x(), texel_.x()) + 1);
  const int v_end = std::min(image_.height(), first(shape.center.y() + reach.y(), texel_.y()) + 1);
  for (int v = first(shape.center.y() - reach.y(), texel_.y()); v < v_end; ++v) {
    for (int u = first(shape.center.x() - reach.x(), texel_.x()); u < u_end; ++u) {
      const Eigen::Vector2d p =
          Eigen::Vector2d((u + 0.5) * texel_.x(), (v + 0.5) * texel_.y()) - shape.center;
      const double outside = signed_distance(shape, {c * p.x() + s * p.y(), c * p.y() - s * p.x()});
      const double coverage = std::clamp(0.5 - outside / texel_.x(), 0.0, 1.0);
      if (coverage > 0) blend(image_(u, v), shape.color, shape.opacity * static_cast<float>(coverage));
    }
  }
}

void Canvas::scatter(const ScatterStyle& style, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                     Random& random) {
  const double area = (high.x() - low.x()) * (high.y() - low.y());
  const int count = static_cast<int>(std::lround(style.per_square_metre * area));
  for (int i = 0; i < count; ++i) {
    Shape shape;
    shape.center = {random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y())};
    const double size =
        style.max_size * std::pow(style.min_size / style.max_size, (i + random.uniform()) / count);
    shape.half = {size, size * random.uniform(0.3, 1.0)};
    shape.angle = random.uniform(0, 3.14159265358979);
    shape.round = random.index(2) == 0;
    shape.color = random_color(random, style.saturation, 20, 250);
    shape.opacity = style.opacity * static_cast<float>(random.uniform(0.5, 1.0));
    draw(shape);
  }
}

Color random_color(Random& random, float saturation, float min_value, float max_value) {
  const auto value = static_cast<float>(random.uniform(min_value, max_value));
  const auto purity = saturation * static_cast<float>(random.uniform());
  const double hue = random.uniform(0, 6);
  const auto channel = [&](double centre) {
    const double distance = std::abs(std::remainder(hue - centre, 6.0));  // 0 at the hue's own primary
    return value * (1 - purity * static_cast<float>(std::clamp(distance - 1, 0.0, 1.0)));
  };
  return {channel(0), channel(2), channel(4)};
}

}  // namespace cairn
