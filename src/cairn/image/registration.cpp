// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// Half the width and height of a pixel's bounding box, a quarter of what its neighbours are apart; not
/// finite where one of them falls nowhere.
Eigen::Vector2d half_span_of(const Image<Eigen::Vector2d>& pixels, int u, int v) {
  const Eigen::Vector2d along_row = pixels(u + 1, v) - pixels(u - 1, v);
  const Eigen::Vector2d along_column = pixels(u, v + 1) - pixels(u, v - 1);
  return 0.25 * (along_row.cwiseAbs() + along_column.cwiseAbs());
}

}  // namespace

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
  const Eigen::Index count = Eigen::Index{depth_camera_.width} * depth_camera_.height;
  for (Eigen::ArrayXd* array : {&rays_.x, &rays_.y, &rays_.z}) array->resize(count);
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < depth_camera_.height; ++v) {
    for (int u = 0; u < depth_camera_.width; ++u) {
      const Eigen::Vector2d ray =
          depth_camera_.unproject({static_cast<double>(u), static_cast<double>(v)}).value_or(none);
      const Eigen::Vector3d rotated = rotation * ray.homogeneous();
      const Eigen::Index i = Eigen::Index{v} * depth_camera_.width + u;
      rays_.x[i] = rotated.x();
      rays_.y[i] = rotated.y();
      rays_.z[i] = rotated.z();
    }
  }
  rays_.half_u.setConstant(count, 0.5 * color_camera_.fx / depth_camera_.fx);
  rays_.half_v.setConstant(count, 0.5 * color_camera_.fy / depth_camera_.fy);
}

/// The bounding box of a depth pixel in the colour image, from where its neighbours fall; at the border and
/// where one falls nowhere, the focal lengths' ratio stays.
void DepthRegistration::measure_spans() {
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  Image<Eigen::Vector2d> pixels(depth_camera_.width, depth_camera_.height, none);
  for (Eigen::Index i = 0; i < rays_.x.size(); ++i)
    pixels.data()[i] = color_camera_.project({rays_.x[i], rays_.y[i], rays_.z[i]}).value_or(none);
  for (int v = 1; v + 1 < pixels.height(); ++v) {
    for (int u = 1; u + 1 < pixels.width(); ++u) {
      const Eigen::Vector2d half_span = half_span_of(pixels, u, v);
      const Eigen::Index i = &pixels(u, v) - pixels.data();
      if (!half_span.allFinite()) continue;
      rays_.half_u[i] = half_span.x();
      rays_.half_v[i] = half_span.y();
    }
  }
}

/// Centres and depths in the colour camera. A camera without distortion, which is the rule, is computed for
/// the whole row at once, as Camera::project does.
void DepthRegistration::place(Row& row) const {
  const Eigen::Index n = row.depth.size();
  const auto x = rays_.x.segment(row.first_ray, n), y = rays_.y.segment(row.first_ray, n);
  row.z = rays_.z.segment(row.first_ray, n) * row.depth + translation_.z();
  if (color_camera_.model == CameraModel::pinhole) {
    row.u = color_camera_.fx * ((x * row.depth + translation_.x()) / row.z) + color_camera_.cx;
    row.v = color_camera_.fy * ((y * row.depth + translation_.y()) / row.z) + color_camera_.cy;
    return;
  }
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d point(x[i] * row.depth[i] + translation_.x(),
                                y[i] * row.depth[i] + translation_.y(), row.z[i]);
    const Eigen::Vector2d pixel = color_camera_.project(point).value_or(none);
    row.u[i] = pixel.x();
    row.v[i] = pixel.y();
  }
}

/// The first whole numbers not below `low` in [0, size]; nothing in particular for NaN.
Eigen::ArrayXd first_in(const Eigen::ArrayXd& low, double size) {
  return low.max(0.0).min(size).ceil();
}

/// The colour pixels whose centres a depth pixel covers; neighbours of equal depth tile.
void DepthRegistration::cover(Row& row) const {
  constexpr double kRounding =
      1e-6;  // neighbours may overlap by so much, so that no gap is left between them
  const Eigen::Index n = row.depth.size();
  const Eigen::ArrayXd nearness = row.depth / row.z;
  const Eigen::ArrayXd reach_u = rays_.half_u.segment(row.first_ray, n) * nearness + kRounding;
  const Eigen::ArrayXd reach_v = rays_.half_v.segment(row.first_ray, n) * nearness + kRounding;
  row.u_begin = first_in(row.u - reach_u, color_camera_.width);
  row.u_end = first_in(row.u + reach_u, color_camera_.width);
  row.v_begin = first_in(row.v - reach_v, color_camera_.height);
  row.v_end = first_in(row.v + reach_v, color_camera_.height);
}

/// The nearest surface stays.
void DepthRegistration::draw(const Row& row, DepthImage& registered) {
  constexpr double kMinDepth = 1e-9;  // metres: nearer is not in front of the colour camera
  for (Eigen::Index i = 0; i < row.depth.size(); ++i) {
    if (!(row.depth[i] > 0) || !(row.z[i] > kMinDepth)) continue;
    if (!(row.u_begin[i] < row.u_end[i]) || !(row.v_begin[i] < row.v_end[i]))
      continue;  // nor where it is NaN
    const auto z = static_cast<float>(row.z[i]);
    const int u_begin = static_cast<int>(row.u_begin[i]), u_end = static_cast<int>(row.u_end[i]);
    const int v_begin = static_cast<int>(row.v_begin[i]), v_end = static_cast<int>(row.v_end[i]);
    for (int v = v_begin; v < v_end; ++v) {
      for (int u = u_begin; u < u_end; ++u) {
        float& nearest = registered(u, v);
        if (nearest == 0.0F || z < nearest) nearest = z;
      }
    }
  }
}

DepthImage DepthRegistration::operator()(const DepthImage& depth) const {
  require(depth.width() == depth_camera_.width && depth.height() == depth_camera_.height,
          "a depth image has the depth camera's size");
  DepthImage registered(color_camera_.width, color_camera_.height);
  const Eigen::Index width = depth.width();
  Row row;
  for (Eigen::ArrayXd* array : {&row.u, &row.v}) array->resize(width);
  for (int v = 0; v < depth.height(); ++v) {
    row.first_ray = v * width;
    row.depth = Eigen::Map<const Eigen::ArrayXf>(depth.row(v), width).cast<double>();
    place(row);
    cover(row);
    draw(row, registered);
  }
  return registered;
}

}  // namespace cairn
