// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"

namespace cairn {

DepthImage depth_in_metres(const RawDepthImage& raw, double scale,
                           const std::vector<std::uint16_t>& invalid) {
  require(scale > 0, "depth has a scale above 0");
  DepthImage depth(raw.width(), raw.height());
  const double metres_per_unit = 1.0 / scale;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::uint16_t value = raw.data()[i];
    const bool known = std::find(invalid.begin(), invalid.end(), value) == invalid.end();
    depth.data()[i] = known ? static_cast<float>(value * metres_per_unit) : 0.0F;
  }
  return depth;
}

DepthRegistration::DepthRegistration(const Camera& depth_camera, const Camera& color_camera,
                                     const Rigid3& camera_from_depth)
    : depth_camera_(depth_camera), color_camera_(color_camera), translation_(camera_from_depth.translation) {
  cast_rays(camera_from_depth.matrix3());
  measure_spans();
}

void DepthRegistration::cast_rays(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const Eigen::Vector2d magnification(color_camera_.fx / depth_camera_.fx,
                                      color_camera_.fy / depth_camera_.fy);
  for (int v = 0; v < depth_camera_.height; ++v) {
    for (int u = 0; u < depth_camera_.width; ++u) {
      const Eigen::Vector2d ray =
          depth_camera_.unproject({static_cast<double>(u), static_cast<double>(v)}).value_or(none);
      rays_.push_back({rotation * ray.homogeneous(), 0.5 * magnification});
    }
  }
}

/// The bounding box of a depth pixel in the colour image, from where its neighbours fall; at the border and
/// where one falls nowhere, the focal lengths' ratio stays.
void DepthRegistration::measure_spans() {
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  Image<Eigen::Vector2d> pixels(depth_camera_.width, depth_camera_.height, none);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels.data()[i] = color_camera_.project(rays_[i].rotated).value_or(none);
  for (int v = 1; v + 1 < pixels.height(); ++v) {
    for (int u = 1; u + 1 < pixels.width(); ++u) {
      const Eigen::Vector2d along_row = pixels(u + 1, v) - pixels(u - 1, v);
      const Eigen::Vector2d along_column = pixels(u, v + 1) - pixels(u, v - 1);
      const Eigen::Vector2d half_span = 0.25 * (along_row.cwiseAbs() + along_column.cwiseAbs());
      const auto i = static_cast<std::size_t>(&pixels(u, v) - pixels.data());
      if (half_span.allFinite()) rays_[i].half_span = half_span;
    }
  }
}

/// One depth pixel into the colour pixels whose centres it covers; neighbours of equal depth tile.
void DepthRegistration::splat(DepthImage& registered, const PixelRay& ray, double depth) const {
  const Eigen::Vector3d point = ray.rotated * depth + translation_;
  const auto centre = color_camera_.project(point);
  if (!centre) return;
  const auto first_in = [](double low, int size) {  // NaN becomes 0
    return static_cast<int>(std::ceil(std::min(std::max(0.0, low), static_cast<double>(size))));
  };
  constexpr double kRounding =
      1e-6;  // neighbours may overlap by so much, so that no gap is left between them
  const Eigen::Vector2d half = (ray.half_span * (depth / point.z())).array() + kRounding;
  const int u_begin = first_in(centre->x() - half.x(), registered.width());
  const int u_end = first_in(centre->x() + half.x(), registered.width());
  const int v_begin = first_in(centre->y() - half.y(), registered.height());
  const int v_end = first_in(centre->y() + half.y(), registered.height());
  const auto z = static_cast<float>(point.z());
  for (int v = v_begin; v < v_end; ++v) {
    for (int u = u_begin; u < u_end; ++u) {
      float& nearest = registered(u, v);
      if (nearest == 0.0F || z < nearest) nearest = z;
    }
  }
}

DepthImage DepthRegistration::operator()(const DepthImage& depth) const {
  require(depth.width() == depth_camera_.width && depth.height() == depth_camera_.height,
          "a depth image has the depth camera's size");
  DepthImage registered(color_camera_.width, color_camera_.height);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth.data()[i] > 0) splat(registered, rays_[i], static_cast<double>(depth.data()[i]));
  }
  return registered;
}

}  // namespace cairn
