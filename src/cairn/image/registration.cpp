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
    : depth_camera_(depth_camera),
      color_camera_(color_camera),
      translation_(camera_from_depth.translation),
      magnification_(color_camera.fx / depth_camera.fx, color_camera.fy / depth_camera.fy) {
  const Eigen::Matrix3d rotation = camera_from_depth.matrix3();
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < depth_camera.height; ++v) {
    for (int u = 0; u < depth_camera.width; ++u) {
      const Eigen::Vector2d ray =
          depth_camera.unproject({static_cast<double>(u), static_cast<double>(v)}).value_or(none);
      rotated_rays_.emplace_back(rotation * ray.homogeneous());
    }
  }
}

/// One depth pixel into the colour pixels whose centres it covers; neighbours of equal depth tile.
void DepthRegistration::splat(DepthImage& registered, const Eigen::Vector3d& rotated_ray,
                              double depth) const {
  const Eigen::Vector3d point = rotated_ray * depth + translation_;
  const auto centre = color_camera_.project(point);
  if (!centre || !(std::abs(centre->x()) < 1e6) || !(std::abs(centre->y()) < 1e6)) return;
  const Eigen::Vector2d half = magnification_ * (0.5 * depth / point.z());
  const int u_begin = std::max(0, static_cast<int>(std::ceil(centre->x() - half.x())));
  const int u_end = std::min(registered.width(), static_cast<int>(std::ceil(centre->x() + half.x())));
  const int v_begin = std::max(0, static_cast<int>(std::ceil(centre->y() - half.y())));
  const int v_end = std::min(registered.height(), static_cast<int>(std::ceil(centre->y() + half.y())));
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
    if (depth.data()[i] > 0) splat(registered, rotated_rays_[i], static_cast<double>(depth.data()[i]));
  }
  return registered;
}

}  // namespace cairn
