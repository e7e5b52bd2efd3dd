// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/render_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr Rgb8 kBegin{36, 98, 235}, kEnd{249, 115, 22};

/// Draws lines in space; widths are in pixels of a picture 1600 wide.
class Pen {
 public:
  Pen(RgbImage& picture, const DepthImage& depth, const Camera& camera, const Rigid3& camera_from_world)
      : picture_(picture),
        depth_(depth),
        camera_(camera),
        camera_from_world_(camera_from_world),
        unit_(camera.width / 1600.0) {}

  void line(const Eigen::Vector3d& from_in_world, const Eigen::Vector3d& to_in_world, double width,
            const Rgb8& color) {
    constexpr double kNear = 0.05;  // metres
    const Eigen::Vector3d a = camera_from_world_ * from_in_world, b = camera_from_world_ * to_in_world;
    if (a.z() < kNear || b.z() < kNear) return;
    const Eigen::Vector2d pa = project(a), pb = project(b);
    const double length = (pb - pa).norm();
    if (!(length < 4.0 * camera_.width)) return;
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * length)));
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const Eigen::Vector2d pixel = pa + share * (pb - pa);
      const double z = 1.0 / ((1 - share) / a.z() + share / b.z());  // depth is linear in 1/z on a line
      stamp(pixel, 0.5 * width * unit_, z, color);
    }
  }

 private:
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {camera_.fx * p.x() / p.z() + camera_.cx, camera_.fy * p.y() / p.z() + camera_.cy};
  }

  void stamp(const Eigen::Vector2d& pixel, double radius, double z, const Rgb8& color) {
    constexpr double kTolerance = 0.03;  // metres: a line on a surface is before it
    for (int v = static_cast<int>(std::ceil(pixel.y() - radius)); v <= pixel.y() + radius; ++v) {
      for (int u = static_cast<int>(std::ceil(pixel.x() - radius)); u <= pixel.x() + radius; ++u) {
        if (!picture_.contains(u, v)) continue;
        if ((Eigen::Vector2d(u, v) - pixel).squaredNorm() > radius * radius) continue;
        const auto before = static_cast<double>(depth_(u, v));
        const bool hidden = before > 0 && before < z - kTolerance;
        if (!hidden) picture_(u, v) = color;
      }
    }
  }

  RgbImage& picture_;
  const DepthImage& depth_;
  const Camera& camera_;
  const Rigid3& camera_from_world_;
  double unit_;
};

void draw_frustum(Pen& pen, const Rigid3& world_from_camera, const Rgb8& color) {
  constexpr double kDepth = 0.09, kHalfWidth = 0.06, kHalfHeight = 0.045;  // metres
  constexpr double kWidth = 2;
  const std::array<Eigen::Vector3d, 4> corners = {
      world_from_camera * Eigen::Vector3d(-kHalfWidth, -kHalfHeight, kDepth),
      world_from_camera * Eigen::Vector3d(kHalfWidth, -kHalfHeight, kDepth),
      world_from_camera * Eigen::Vector3d(kHalfWidth, kHalfHeight, kDepth),
      world_from_camera * Eigen::Vector3d(-kHalfWidth, kHalfHeight, kDepth)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    pen.line(corners[i], corners[(i + 1) % corners.size()], kWidth, color);
    pen.line(world_from_camera.translation, corners[i], kWidth, color);
  }
}

}  // namespace

Rgb8 blend(const Rgb8& a, const Rgb8& b, double share) {
  const auto mix = [&](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(std::lround((1 - share) * x + share * y));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

void draw_camera_path(RgbImage& picture, const DepthImage& depth, const Camera& camera,
                      const Rigid3& camera_from_world, const CameraPath& path) {
  constexpr double kHalo = 9, kLine = 5;
  Pen pen(picture, depth, camera, camera_from_world);
  const auto& poses = path.world_from_camera;
  const double last = std::max<double>(1, static_cast<double>(poses.size()) - 1);
  const auto color_at = [&](std::size_t i) { return blend(kBegin, kEnd, static_cast<double>(i) / last); };
  for (std::size_t i = 1; i < poses.size(); ++i)
    pen.line(poses[i - 1].translation, poses[i].translation, kHalo, {255, 255, 255});
  for (std::size_t i = 1; i < poses.size(); ++i)
    pen.line(poses[i - 1].translation, poses[i].translation, kLine, color_at(i));
  for (const std::size_t i : path.keyframes)
    if (i < poses.size()) draw_frustum(pen, poses[i], color_at(i));
}

}  // namespace cairn
