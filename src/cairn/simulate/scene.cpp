// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cairn {
namespace {

/// f(x, y) = at_origin + x * per_column + y * per_row.
struct Affine {
  double at_origin = 0, per_column = 0, per_row = 0;
  [[nodiscard]] double operator()(double x, double y) const {
    return at_origin + x * per_column + y * per_row;
  }
};

/// A surface seen by a camera. A ray is o + t d with d affine in the pixel and of length 1 along the optical
/// axis, so t is the depth. On the plane n.(p - q) = 0 this makes w = 1/t = n.d / n.(q - o) affine in the
/// pixel, and with s = e.(p - q), the distance along an axis e, s w = e.(o - q) w + e.d is affine too. The
/// pixel sees the surface where w > 0, 0 <= s w <= length w: four straight lines.
struct SeenSurface {
  Affine inverse_depth;  // w
  Affine along_right;    // s w for e = right
  Affine along_down;     // s w for e = down
  double width = 0, height = 0;
  Eigen::Vector2d texels_per_metre;
  const Texture* texture = nullptr;

  [[nodiscard]] bool covers(double x, double y) const {
    const double w = inverse_depth(x, y), a = along_right(x, y), b = along_down(x, y);
    return w > 0 && a >= 0 && a <= width * w && b >= 0 && b <= height * w;
  }
  [[nodiscard]] Color color_at(double x, double y, double pixel_size) const;
};

Color SeenSurface::color_at(double x, double y, double pixel_size) const {
  const double depth = 1 / inverse_depth(x, y);
  const Eigen::Vector2d place(along_right(x, y) * depth, along_down(x, y) * depth);  // metres
  const auto step = [&](double right, double down, double w) -> Eigen::Vector2d {
    return (depth * pixel_size * (Eigen::Vector2d(right, down) - place * w)).cwiseProduct(texels_per_metre);
  };
  const Eigen::Vector2d position = place.cwiseProduct(texels_per_metre) - Eigen::Vector2d(0.5, 0.5);
  return texture->sample(position,
                         step(along_right.per_column, along_down.per_column, inverse_depth.per_column),
                         step(along_right.per_row, along_down.per_row, inverse_depth.per_row));
}

/// The rays of all pixels: direction = at_origin + x * per_column + y * per_row in the scene's frame.
struct Rays {
  Eigen::Vector3d origin, at_origin, per_column, per_row;

  Rays(const Camera& camera, const Rigid3& scene_from_camera) : origin(scene_from_camera.translation) {
    const Eigen::Matrix3d axes = scene_from_camera.matrix3();
    per_column = axes.col(0) / camera.fx;
    per_row = axes.col(1) / camera.fy;
    at_origin = axes.col(2) - camera.cx * per_column - camera.cy * per_row;
  }
  [[nodiscard]] Affine along(const Eigen::Vector3d& axis) const {
    return {axis.dot(at_origin), axis.dot(per_column), axis.dot(per_row)};
  }
};

Affine scaled(const Affine& f, double factor) {
  return {f.at_origin * factor, f.per_column * factor, f.per_row * factor};
}

Affine sum(const Affine& f, const Affine& g) {
  return {f.at_origin + g.at_origin, f.per_column + g.per_column, f.per_row + g.per_row};
}

std::optional<SeenSurface> see(const Surface& surface, const Texture& texture, const Rays& rays) {
  const Eigen::Vector3d normal = surface.right.cross(surface.down);  // away from the viewer
  const Eigen::Vector3d to_corner = surface.corner - rays.origin;
  const double distance = normal.dot(to_corner);
  if (distance <= 1e-6) return std::nullopt;
  SeenSurface seen;
  seen.inverse_depth = scaled(rays.along(normal), 1 / distance);
  seen.along_right =
      sum(scaled(seen.inverse_depth, -surface.right.dot(to_corner)), rays.along(surface.right));
  seen.along_down = sum(scaled(seen.inverse_depth, -surface.down.dot(to_corner)), rays.along(surface.down));
  seen.width = surface.width;
  seen.height = surface.height;
  seen.texels_per_metre = {texture.width() / surface.width, texture.height() / surface.height};
  seen.texture = &texture;
  return seen;
}

/// The columns of a row that a surface covers: an interval, because each of its borders is a straight line.
class ColumnSpan {
 public:
  explicit ColumnSpan(int width) : end_(width) {}

  /// Keeps the columns x where f(x, y) >= 0.
  void keep(const Affine& f, double y) {
    const double at_zero = f.at_origin + y * f.per_row;
    if (f.per_column == 0) {
      if (at_zero < 0) end_ = 0;
      return;
    }
    const double root = std::clamp(-at_zero / f.per_column, -1.0, end_ + 1.0);
    if (f.per_column > 0) {
      begin_ = std::max(begin_, static_cast<int>(std::ceil(root)));
    } else {
      end_ = std::min(end_, static_cast<int>(std::floor(root)) + 1);
    }
  }
  [[nodiscard]] int begin() const { return begin_; }
  [[nodiscard]] int end() const { return end_; }
  [[nodiscard]] bool empty() const { return begin_ >= end_; }

 private:
  int begin_ = 0, end_;
};

constexpr std::int16_t kNothing = -1;

/// Which surface each pixel's centre sees, and its inverse depth.
struct HitImage {
  Image<std::int16_t> surface;
  Image<double> inverse_depth;
};

void cast_row(const std::vector<SeenSurface>& surfaces, int v, HitImage& hits) {
  std::int16_t* surface_row = hits.surface.row(v);
  double* depth_row = hits.inverse_depth.row(v);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SeenSurface& s = surfaces[i];
    ColumnSpan span(hits.surface.width());
    const Affine &w = s.inverse_depth, &a = s.along_right, &b = s.along_down;
    span.keep(w, v);
    span.keep(a, v);
    span.keep(b, v);
    if (span.empty()) continue;
    span.keep(sum(scaled(w, s.width), scaled(a, -1)), v);
    span.keep(sum(scaled(w, s.height), scaled(b, -1)), v);
    const double at_zero = w.at_origin + v * w.per_row;
    for (int u = span.begin(); u < span.end(); ++u) {
      const double here = at_zero + u * w.per_column;
      if (here <= depth_row[u]) continue;
      depth_row[u] = here;
      surface_row[u] = static_cast<std::int16_t>(i);
    }
  }
}

/// The different surfaces in the 3x3 pixels about a pixel.
struct Neighbourhood {
  std::array<std::int16_t, 9> surfaces{};
  int count = 0;

  Neighbourhood(const Image<std::int16_t>& hit, int u, int v) {
    for (int y = std::max(0, v - 1); y <= std::min(hit.height() - 1, v + 1); ++y)
      for (int x = std::max(0, u - 1); x <= std::min(hit.width() - 1, u + 1); ++x) add(hit(x, y));
  }

 private:
  void add(std::int16_t surface) {
    const auto end = surfaces.begin() + count;
    if (std::find(surfaces.begin(), end, surface) == end)
      surfaces[static_cast<std::size_t>(count++)] = surface;
  }
};

class Shader {
 public:
  Shader(const std::vector<SeenSurface>& surfaces, const HitImage& hits, const Color& background)
      : surfaces_(surfaces), hits_(hits), background_(background) {}

  [[nodiscard]] Color operator()(int u, int v) const {
    if (!at_border(u, v)) return color_of(hits_.surface(u, v), u, v, 1.0);
    const Neighbourhood near(hits_.surface, u, v);
    constexpr double kOffsets[4][2] = {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}};
    Color total = Color::Zero();
    for (const auto& [dx, dy] : kOffsets)
      total += color_of(nearest(near, u + dx, v + dy), u + dx, v + dy, 0.5);
    return total / 4;
  }

 private:
  [[nodiscard]] bool at_border(int u, int v) const {
    const auto& s = hits_.surface;
    const std::int16_t here = s(u, v);
    return (u > 0 && s(u - 1, v) != here) || (u + 1 < s.width() && s(u + 1, v) != here) ||
           (v > 0 && s(u, v - 1) != here) || (v + 1 < s.height() && s(u, v + 1) != here);
  }
  [[nodiscard]] std::int16_t nearest(const Neighbourhood& near, double x, double y) const {
    std::int16_t best = kNothing;
    double best_inverse_depth = 0;
    for (int i = 0; i < near.count; ++i) {
      const std::int16_t index = near.surfaces[static_cast<std::size_t>(i)];
      if (index == kNothing) continue;
      const SeenSurface& surface = surfaces_[static_cast<std::size_t>(index)];
      const double here = surface.inverse_depth(x, y);
      if (here <= best_inverse_depth || !surface.covers(x, y)) continue;
      best = index;
      best_inverse_depth = here;
    }
    return best;
  }
  [[nodiscard]] Color color_of(std::int16_t surface, double x, double y, double pixel_size) const {
    if (surface == kNothing) return background_;
    return surfaces_[static_cast<std::size_t>(surface)].color_at(x, y, pixel_size);
  }

  const std::vector<SeenSurface>& surfaces_;
  const HitImage& hits_;
  Color background_;
};

}  // namespace

SceneImage render_scene(const Scene& scene, const Camera& camera, const Rigid3& scene_from_camera) {
  require(camera.model == CameraModel::pinhole, "a scene is rendered without distortion");
  require(scene.surfaces.size() < std::numeric_limits<std::int16_t>::max(), "a scene has few surfaces");
  const Rays rays(camera, scene_from_camera);
  std::vector<SeenSurface> surfaces;
  for (const Surface& surface : scene.surfaces) {
    const auto seen = see(surface, scene.textures[static_cast<std::size_t>(surface.texture)], rays);
    if (seen) surfaces.push_back(*seen);
  }
  HitImage hits{{camera.width, camera.height, kNothing}, {camera.width, camera.height, 0.0}};
  for (int v = 0; v < camera.height; ++v) cast_row(surfaces, v, hits);
  SceneImage image{{camera.width, camera.height, Color::Zero()}, {camera.width, camera.height}};
  const Shader shade(surfaces, hits, scene.background);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double w = hits.inverse_depth(u, v);
      image.light(u, v) = shade(u, v);
      image.depth(u, v) = w > 0 ? static_cast<float>(1 / w) : 0.0F;
    }
  }
  return image;
}

}  // namespace cairn
