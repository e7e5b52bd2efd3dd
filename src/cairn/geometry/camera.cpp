// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera.h"

#include <Eigen/LU>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMinDepth = 1e-9;

bool is_in_field(const Camera& camera, const Eigen::Vector2d& p) {
  switch (camera.model) {
    case CameraModel::radtan:
      return radtan::is_in_field(camera.distortion, p);
    case CameraModel::kb4:
      return kb4::is_in_field(camera.distortion, p);
    case CameraModel::pinhole:
      break;
  }
  return true;
}

Eigen::Vector2d distort(const Camera& camera, const Eigen::Vector2d& p) {
  switch (camera.model) {
    case CameraModel::radtan:
      return radtan::distort(camera.distortion, p);
    case CameraModel::kb4:
      return kb4::distort(camera.distortion, p);
    case CameraModel::pinhole:
      break;
  }
  return p;
}

Eigen::Matrix2d distort_by_point(const Camera& camera, const Eigen::Vector2d& p) {
  switch (camera.model) {
    case CameraModel::radtan:
      return radtan::distort_by_point(camera.distortion, p);
    case CameraModel::kb4:
      return kb4::distort_by_point(camera.distortion, p);
    case CameraModel::pinhole:
      break;
  }
  return Eigen::Matrix2d::Identity();
}

DistortionJacobian distort_by_coefficients(const Camera& camera, const Eigen::Vector2d& p) {
  switch (camera.model) {
    case CameraModel::radtan:
      return radtan::distort_by_coefficients(p);
    case CameraModel::kb4:
      return kb4::distort_by_coefficients(p);
    case CameraModel::pinhole:
      break;
  }
  return DistortionJacobian::Zero();
}

/// (x/z, y/z) of a point that the camera sees.
std::optional<Eigen::Vector2d> to_plane(const Camera& camera, const Eigen::Vector3d& point) {
  if (!(point.z() > kMinDepth)) return std::nullopt;
  const Eigen::Vector2d p = point.head<2>() / point.z();
  if (!p.allFinite() || !is_in_field(camera, p)) return std::nullopt;
  return p;
}

}  // namespace

std::string_view to_string(CameraModel model) {
  switch (model) {
    case CameraModel::radtan:
      return "radtan";
    case CameraModel::kb4:
      return "kb4";
    case CameraModel::pinhole:
      break;
  }
  return "pinhole";
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point_in_camera) const {
  const auto plane = to_plane(*this, point_in_camera);
  if (!plane) return std::nullopt;
  const Eigen::Vector2d p = distort(*this, *plane);
  return Eigen::Vector2d(fx * p.x() + cx, fy * p.y() + cy);
}

std::optional<ProjectedPoint> Camera::project_with_jacobians(const Eigen::Vector3d& point_in_camera) const {
  const auto plane = to_plane(*this, point_in_camera);
  if (!plane) return std::nullopt;
  const Eigen::Vector2d p = distort(*this, *plane);
  const Eigen::Vector2d focal_lengths(fx, fy);
  ProjectedPoint projected;
  projected.pixel = {fx * p.x() + cx, fy * p.y() + cy};
  const double inverse_depth = 1.0 / point_in_camera.z();
  Eigen::Matrix<double, 2, 3> plane_by_point;
  plane_by_point << inverse_depth, 0, -inverse_depth * plane->x(),  //
      0, inverse_depth, -inverse_depth * plane->y();
  projected.by_point = focal_lengths.asDiagonal() * distort_by_point(*this, *plane) * plane_by_point;
  projected.by_intrinsics.leftCols<4>() << p.x(), 0, 1, 0,  //
      0, p.y(), 0, 1;
  projected.by_intrinsics.rightCols<5>() =
      focal_lengths.asDiagonal() * distort_by_coefficients(*this, *plane);
  return projected;
}

std::optional<Eigen::Vector2d> Camera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (model == CameraModel::radtan) return radtan::undistort(distortion, p);
  if (model == CameraModel::kb4) return kb4::undistort(distortion, p);
  return p.allFinite() ? std::optional(p) : std::nullopt;
}

std::optional<UnprojectedPixel> Camera::unproject_with_jacobian(const Eigen::Vector2d& pixel) const {
  const auto ray = unproject(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector2d inverse_focal_lengths(1.0 / fx, 1.0 / fy);
  Eigen::Matrix2d inverse;
  bool invertible = false;
  distort_by_point(*this, *ray).computeInverseWithCheck(inverse, invertible);
  if (!invertible) return std::nullopt;
  return UnprojectedPixel{*ray, inverse * inverse_focal_lengths.asDiagonal()};
}

std::optional<Eigen::Vector3d> Camera::back_project(const Eigen::Vector2d& pixel, double depth) const {
  const auto p = unproject(pixel);
  if (!p) return std::nullopt;
  return Eigen::Vector3d(p->x() * depth, p->y() * depth, depth);
}

bool Camera::contains(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width - 1 && pixel.y() <= height - 1;
}

Camera Camera::undistorted() const {
  Camera plain = *this;
  plain.model = CameraModel::pinhole;
  plain.distortion = {};
  return plain;
}

}  // namespace cairn
