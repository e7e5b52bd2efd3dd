// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/render.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/report/render_path.h"

namespace cairn {
namespace {

constexpr float kNothing = 0;  // depth where no point fell

/// What is drawn on: the picture, some times larger.
struct Canvas {
  Camera camera;
  Rigid3 camera_from_world;
  RgbImage color;
  DepthImage depth;
};

Canvas make_canvas(const RenderCamera& view, int scale) {
  Camera camera = view.camera;
  camera.width *= scale;
  camera.height *= scale;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx + 0.5) * scale - 0.5;
  camera.cy = (camera.cy + 0.5) * scale - 0.5;
  return {camera, view.world_from_camera.inverse(), RgbImage(camera.width, camera.height),
          DepthImage(camera.width, camera.height, kNothing)};
}

/// A disc around (u, v), at one depth. Radius in pixels.
void splat(Canvas& canvas, double u, double v, double radius, float depth, const Rgb8& color) {
  const int low_u = std::max(0, static_cast<int>(std::ceil(u - radius)));
  const int high_u = std::min(canvas.camera.width - 1, static_cast<int>(std::floor(u + radius)));
  const int low_v = std::max(0, static_cast<int>(std::ceil(v - radius)));
  const int high_v = std::min(canvas.camera.height - 1, static_cast<int>(std::floor(v + radius)));
  const double squared = radius < 1.5 ? 4 * radius * radius : radius * radius;  // small ones are squares
  for (int y = low_v; y <= high_v; ++y) {
    for (int x = low_u; x <= high_u; ++x) {
      if ((x - u) * (x - u) + (y - v) * (y - v) > squared) continue;
      float& nearest = canvas.depth(x, y);
      if (nearest != kNothing && nearest <= depth) continue;
      nearest = depth;
      canvas.color(x, y) = color;
    }
  }
}

bool faces_away(const SurfaceCell& cell, const Eigen::Vector3f& point, const Eigen::Vector3f& eye) {
  constexpr float kGrazing = -0.05F;  // 3 degrees behind the tangent
  if (!cell.seen) return false;
  const Eigen::Vector3f way = eye - point;
  return cell.normal.dot(way) < kGrazing * way.norm();
}

void draw_points(Canvas& canvas, const Cloud& cloud, const RenderOptions& options,
                 const CloudSurface* surface, const Eigen::Vector3f& eye) {
  constexpr double kOverlap = 0.75;    // discs of 1.5 voxels close a surface of one point per voxel
  constexpr double kMinRadius = 0.71;  // half the diagonal of a pixel
  constexpr double kNear = 0.05;       // metres
  const Camera& camera = canvas.camera;
  const Eigen::Matrix3d rotation = canvas.camera_from_world.matrix3();
  const double size = kOverlap * options.point_size * camera.fx;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const CloudPoint& p = cloud.points[i];
    const Eigen::Vector3f point(p.x, p.y, p.z);
    if (surface != nullptr && faces_away(surface->cell_of_point(i), point, eye)) continue;
    const Eigen::Vector3d in_camera = rotation * point.cast<double>() + canvas.camera_from_world.translation;
    if (in_camera.z() < kNear) continue;
    const double u = camera.fx * in_camera.x() / in_camera.z() + camera.cx;
    const double v = camera.fy * in_camera.y() / in_camera.z() + camera.cy;
    const double radius = std::max(kMinRadius, size / in_camera.z());
    if (u < -radius || v < -radius || u > camera.width + radius || v > camera.height + radius) continue;
    splat(canvas, u, v, radius, static_cast<float>(in_camera.z()), {p.r, p.g, p.b});
  }
}

Image<float> log_depth(const DepthImage& depth) {
  Image<float> logs(depth.width(), depth.height());
  for (std::size_t i = 0; i < depth.size(); ++i)
    logs.data()[i] = depth.data()[i] == kNothing ? 1e6F : std::log2(depth.data()[i]);
  return logs;
}

/// Boucheny 2009: a pixel is darkened by the neighbours that lie nearer to the eye.
void shade_edges(Canvas& canvas, double strength, int reach) {
  constexpr std::array<std::array<int, 2>, 8> kAround = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  constexpr float kMaxStep = 0.06F;  // 4 % of the depth: one far foreground is no darker than a near one
  const Image<float> logs = log_depth(canvas.depth);
  for (int v = 0; v < canvas.camera.height; ++v) {
    for (int u = 0; u < canvas.camera.width; ++u) {
      if (canvas.depth(u, v) == kNothing) continue;
      float occlusion = 0;
      for (const auto& [du, dv] : kAround) {
        if (logs.contains(u + reach * du, v + reach * dv))
          occlusion += std::clamp(logs(u, v) - logs(u + reach * du, v + reach * dv), 0.0F, kMaxStep);
      }
      const auto light = static_cast<float>(std::exp(-strength * static_cast<double>(occlusion) / 8.0));
      Rgb8& pixel = canvas.color(u, v);
      const auto darken = [&](std::uint8_t c) {
        return static_cast<std::uint8_t>(light * static_cast<float>(c));
      };
      pixel = {darken(pixel.r), darken(pixel.g), darken(pixel.b)};
    }
  }
}

void fill_background(Canvas& canvas, const RenderOptions& options) {
  for (int v = 0; v < canvas.camera.height; ++v) {
    const double share = static_cast<double>(v) / std::max(1, canvas.camera.height - 1);
    const Rgb8 color = blend(options.background_top, options.background_bottom, share);
    for (int u = 0; u < canvas.camera.width; ++u)
      if (canvas.depth(u, v) == kNothing) canvas.color(u, v) = color;
  }
}

RgbImage average_down(const RgbImage& large, int scale) {
  if (scale == 1) return large;
  RgbImage small(large.width() / scale, large.height() / scale);
  const int count = scale * scale;
  for (int v = 0; v < small.height(); ++v) {
    for (int u = 0; u < small.width(); ++u) {
      std::array<int, 3> sum{};
      for (int k = 0; k < count; ++k) {
        const Rgb8& pixel = large(u * scale + k % scale, v * scale + k / scale);
        sum[0] += pixel.r;
        sum[1] += pixel.g;
        sum[2] += pixel.b;
      }
      const auto mean = [&](std::size_t i) {
        return static_cast<std::uint8_t>((sum[i] + count / 2) / count);
      };
      small(u, v) = {mean(0), mean(1), mean(2)};
    }
  }
  return small;
}

}  // namespace

RgbImage render_cloud(const Cloud& cloud, const RenderCamera& view, const RenderOptions& options,
                      const CloudSurface* surface, const CameraPath* path) {
  require(view.camera.model == CameraModel::pinhole, "a view has no distortion");
  require(view.camera.width > 0 && view.camera.height > 0, "a view has pixels");
  require(options.supersampling >= 1 && options.point_size > 0, "sizes are above 0");
  Canvas canvas = make_canvas(view, options.supersampling);
  draw_points(canvas, cloud, options, surface, view.world_from_camera.translation.cast<float>());
  shade_edges(canvas, options.edge_strength, options.supersampling);
  fill_background(canvas, options);
  if (path != nullptr)
    draw_camera_path(canvas.color, canvas.depth, canvas.camera, canvas.camera_from_world, *path);
  return average_down(canvas.color, options.supersampling);
}

}  // namespace cairn
