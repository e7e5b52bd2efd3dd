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
  const auto corners_per_row = static_cast<std::size_t>(depth_camera.width) + 1;
  rotated_rays_.reserve(corners_per_row * (static_cast<std::size_t>(depth_camera.height) + 1));
  const Eigen::Matrix3d rotation = camera_from_depth.matrix3();
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v <= depth_camera.height; ++v) {
    for (int u = 0; u <= depth_camera.width; ++u) {
      const Eigen::Vector2d ray = depth_camera.unproject({u - 0.5, v - 0.5}).value_or(none);
      rotated_rays_.push_back(rotation * ray.homogeneous());
    }
  }
}

std::optional<Eigen::Vector2d> DepthRegistration::color_pixel(const Eigen::Vector3d& rotated_ray,
                                                              double depth) const {
  return color_camera_.project(rotated_ray * depth + translation_);
}

/// The colour pixels whose centres the depth pixel covers, cut to the image; neighbours of equal depth tile.
std::optional<DepthRegistration::Footprint> DepthRegistration::footprint(std::size_t upper_left,
                                                                         double depth) const {
  const std::size_t lower_right = upper_left + static_cast<std::size_t>(depth_camera_.width) + 2;
  const auto a = color_pixel(rotated_rays_[upper_left], depth);
  const auto b = color_pixel(rotated_rays_[lower_right], depth);
  const auto inside = [](double value, int end) {
    return static_cast<int>(std::ceil(std::clamp(value, 0.0, double(end))));
  };
  if (!a || !b || !a->allFinite() || !b->allFinite()) return std::nullopt;
  const int width = color_camera_.width, height = color_camera_.height;
  return Footprint{inside(std::min(a->x(), b->x()), width), inside(std::max(a->x(), b->x()), width),
                   inside(std::min(a->y(), b->y()), height), inside(std::max(a->y(), b->y()), height)};
}

DepthImage DepthRegistration::operator()(const DepthImage& depth) const {
  require(depth.width() == depth_camera_.width && depth.height() == depth_camera_.height,
          "a depth image has the depth camera's size");
  DepthImage registered(color_camera_.width, color_camera_.height);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const double z = static_cast<double>(depth(u, v));
      if (!(z > 0)) continue;
      const std::size_t corner = static_cast<std::size_t>(v) * (static_cast<std::size_t>(depth.width()) + 1) +
                                 static_cast<std::size_t>(u);
      const auto pixels = footprint(corner, z);
      if (!pixels) continue;
      const auto z_in_color = static_cast<float>(rotated_rays_[corner].z() * z + translation_.z());
      for (int y = pixels->v_begin; y < pixels->v_end; ++y) {
        for (int x = pixels->u_begin; x < pixels->u_end; ++x) {
          float& nearest = registered(x, y);
          if (nearest == 0.0F || z_in_color < nearest) nearest = z_in_color;
        }
      }
    }
  }
  return registered;
}

}  // namespace cairn
