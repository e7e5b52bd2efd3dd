// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "cairn/geometry/distortion.h"

namespace cairn {

/// pinhole: no distortion. radtan: Brown-Conrady k1 k2 p1 p2 k3 (as OpenCV and Kalibr). kb4: Kannala-Brandt
/// 2006 equidistant fisheye k1..k4.
enum class CameraModel { pinhole, radtan, kb4 };

[[nodiscard]] std::string_view to_string(CameraModel model);

/// A pixel and how it moves.
struct ProjectedPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;       ///< by the point in the camera's frame, pixels per metre
  Eigen::Matrix<double, 2, 9> by_intrinsics;  ///< by fx fy cx cy, then distortion; 0 for what is unused
};

/// The ray through a pixel and how it moves.
struct UnprojectedPixel {
  Eigen::Vector2d ray;       ///< (x/z, y/z)
  Eigen::Matrix2d by_pixel;  ///< 1 per pixel
};

/// Intrinsics. Camera x right, y down, z forward; pixel (0,0) is the centre of the first pixel.
struct Camera {
  CameraModel model = CameraModel::pinhole;
  int width = 0;            ///< pixels
  int height = 0;           ///< pixels
  double fx = 0, fy = 0;    ///< pixels
  double cx = 0, cy = 0;    ///< pixels
  Distortion distortion{};  ///< in the model's order, 0 where unused

  /// Pixel of a point in the camera's frame; nothing for a point that is not in front of the camera, is no
  /// number, or lies so far aside that the distortion would fold it back into the image.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;
  [[nodiscard]] std::optional<ProjectedPoint> project_with_jacobians(
      const Eigen::Vector3d& point_in_camera) const;
  /// (x/z, y/z) of the ray through a pixel: the inverse of `project`. Nothing where no point is projected to.
  [[nodiscard]] std::optional<Eigen::Vector2d> unproject(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] std::optional<UnprojectedPixel> unproject_with_jacobian(const Eigen::Vector2d& pixel) const;
  /// Point at depth z (metres, along the optical axis) on the ray through a pixel.
  [[nodiscard]] std::optional<Eigen::Vector3d> back_project(const Eigen::Vector2d& pixel, double depth) const;
  /// True for a pixel whose centre lies in the image.
  [[nodiscard]] bool contains(const Eigen::Vector2d& pixel) const;
  /// The camera with the same focal lengths and centre and no distortion.
  [[nodiscard]] Camera undistorted() const;
};

}  // namespace cairn
