// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "cairn/geometry/distortion.h"

namespace cairn {

/// Names the distortion of a camera. pinhole: none. radtan: Brown-Conrady k1 k2 p1 p2 k3 (as OpenCV and
/// Kalibr). kb4: Kannala-Brandt 2006 equidistant fisheye k1..k4.
enum class CameraModel { pinhole, radtan, kb4 };

[[nodiscard]] std::string_view to_string(CameraModel model);

/// Holds the pixel of a point and its derivatives.
struct ProjectedPoint {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;  ///< derivative by the point in the camera's frame, pixels per metre
  /// Derivative by fx fy cx cy, then distortion; 0 for unused ones.
  Eigen::Matrix<double, 2, 9> by_intrinsics;
};

/// Holds the ray through a pixel and its derivative.
struct UnprojectedPixel {
  Eigen::Vector2d ray;       ///< (x/z, y/z)
  Eigen::Matrix2d by_pixel;  ///< derivative of the ray by the pixel, 1/pixel
};

/// Describes the intrinsics of a camera. Axes: x right, y down, z forward; pixel (0, 0) is the centre of the
/// first pixel.
struct Camera {
  CameraModel model = CameraModel::pinhole;
  int width = 0;            ///< pixels
  int height = 0;           ///< pixels
  double fx = 0, fy = 0;    ///< pixels
  double cx = 0, cy = 0;    ///< pixels
  Distortion distortion{};  ///< coefficients in the model's order, 0 if unused

  /// Projects a point in the camera's frame to its pixel. Returns nullopt if the point is not in front of the
  /// camera, is not finite, or lies so far off the axis that the distortion would fold it back into the
  /// image.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera) const;
  /// Projects a point and differentiates its pixel. Returns nullopt if `project` does.
  [[nodiscard]] std::optional<ProjectedPoint> project_with_jacobians(
      const Eigen::Vector3d& point_in_camera) const;
  /// Computes (x/z, y/z) of the ray through a pixel: the inverse of `project`. Returns nullopt if no point
  /// projects to the pixel.
  [[nodiscard]] std::optional<Eigen::Vector2d> unproject(const Eigen::Vector2d& pixel) const;
  /// Computes the ray through a pixel and its derivative. Returns nullopt if `unproject` does or the
  /// distortion is not invertible there.
  [[nodiscard]] std::optional<UnprojectedPixel> unproject_with_jacobian(const Eigen::Vector2d& pixel) const;
  /// Computes the point at depth z (metres, along the optical axis) on the ray through a pixel. Returns
  /// nullopt if `unproject` does.
  [[nodiscard]] std::optional<Eigen::Vector3d> back_project(const Eigen::Vector2d& pixel, double depth) const;
  /// Tells whether the position lies between the centres of the outermost pixels.
  [[nodiscard]] bool contains(const Eigen::Vector2d& pixel) const;
  /// Returns the pinhole camera with the same size, focal lengths and centre.
  [[nodiscard]] Camera undistorted() const;
};

}  // namespace cairn
