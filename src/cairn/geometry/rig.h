// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Describes one observation of a landmark: column, row and disparity in the (undistorted) left image. Stereo
/// measures the disparity; from a depth z it is fx * baseline / z with a virtual baseline; without either it
/// is NaN.
struct Observation {
  double u = 0, v = 0;                                  ///< column and row, pixels
  double d = std::numeric_limits<double>::quiet_NaN();  ///< disparity, pixels; NaN if not measured
  double sigma_px = 1;                                  ///< standard deviation of u and of v
  double sigma_d_px = 1;                                ///< standard deviation of d

  [[nodiscard]] bool has_disparity() const { return d == d; }
};

/// Describes a pinhole camera with a second one `baseline` metres to its right; all residuals are projected
/// with it.
struct Rig {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  double baseline = 0;                    ///< metres, above 0

  [[nodiscard]] double disparity(double depth) const { return fx * baseline / depth; }
  [[nodiscard]] double depth(double disparity_px) const { return fx * baseline / disparity_px; }
  /// Computes by how much the disparity `d` changes with the depth, pixels per metre, without the sign.
  [[nodiscard]] double disparity_per_metre(double d) const { return d * d / (fx * baseline); }
  /// Computes (u, v, d) of a point in front of the camera: u = fx x/z + cx, v = fy y/z + cy, d = fx b/z.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& point_in_camera) const {
    const double inverse_depth = 1.0 / point_in_camera.z();
    return {fx * point_in_camera.x() * inverse_depth + cx, fy * point_in_camera.y() * inverse_depth + cy,
            fx * baseline * inverse_depth};
  }
  /// Computes the derivative of `project` by the point: rows u, v, d; columns x, y, z.
  [[nodiscard]] Eigen::Matrix3d projection_jacobian(const Eigen::Vector3d& point_in_camera) const {
    const double inverse_depth = 1.0 / point_in_camera.z();
    const double x = point_in_camera.x() * inverse_depth, y = point_in_camera.y() * inverse_depth;
    Eigen::Matrix3d jacobian;
    jacobian << fx, 0, -fx * x, 0, fy, -fy * y, 0, 0, -fx * baseline * inverse_depth;
    return jacobian * inverse_depth;
  }
  /// Computes the point in the camera's frame at `depth` (metres, along z) on the ray through (u, v).
  [[nodiscard]] Eigen::Vector3d point_at(double u, double v, double depth) const {
    return {(u - cx) / fx * depth, (v - cy) / fy * depth, depth};
  }
};

/// Tells whether all numbers of two rigs are the same to a millionth: files may have rounded them.
[[nodiscard]] inline bool are_same(const Rig& a, const Rig& b) {
  constexpr double kRelative = 1e-6;
  const auto same = [](double x, double y) { return std::abs(x - y) <= kRelative * std::abs(y); };
  return same(a.fx, b.fx) && same(a.fy, b.fy) && same(a.cx, b.cx) && same(a.cy, b.cy) &&
         same(a.baseline, b.baseline);
}

/// Tells whether a point is in front of the camera: its depth is above a micrometre.
[[nodiscard]] inline bool is_in_front(const Eigen::Vector3d& point_in_camera) {
  constexpr double kMinDepth = 1e-6;
  return point_in_camera.z() > kMinDepth;
}

/// Computes the inverse variances of u, v and d; that of a disparity that was not measured is 0.
[[nodiscard]] inline Eigen::Vector3d inverse_variances(const Observation& seen) {
  const double of_pixel = 1.0 / (seen.sigma_px * seen.sigma_px);
  return {of_pixel, of_pixel, seen.has_disparity() ? 1.0 / (seen.sigma_d_px * seen.sigma_d_px) : 0.0};
}

/// Computes the squared error of an observation in units of its standard deviations: (du^2 + dv^2) / sigma^2
/// [+ dd^2 / sigma_d^2]. Returns infinity if the point is not in front of the camera.
[[nodiscard]] inline double squared_error(const Rig& rig, const Eigen::Vector3d& point_in_camera,
                                          const Observation& seen) {
  if (!is_in_front(point_in_camera)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  const double du = (projected.x() - seen.u) / seen.sigma_px;
  const double dv = (projected.y() - seen.v) / seen.sigma_px;
  const double dd = seen.has_disparity() ? (projected.z() - seen.d) / seen.sigma_d_px : 0.0;
  return du * du + dv * dv + dd * dd;
}

/// Returns the squared_error below which 95 % of the correct observations like `seen` stay: the quantile of
/// chi-square with 3 degrees of freedom if it has a disparity, else with 2.
[[nodiscard]] inline double squared_error_limit(const Observation& seen) {
  return seen.has_disparity() ? kInlierLimit3 : kInlierLimit2;
}

/// Says what of an observation agrees with a point.
enum class Agreement {
  none,
  pixel,  ///< u and v; its disparity is grossly wrong, as at an outline, where it is that of another surface
  full,   ///< everything that was measured
};

/// Judges an observation by its squared errors in variances: `all` of (u, v, d), `pixel` of (u, v). The
/// observation agrees in full below squared_error_limit, else in its pixel if that is below its own limit and
/// what the disparity adds is above kGrossLimit1.
[[nodiscard]] inline Agreement agreement_by(double all, double pixel, const Observation& seen) {
  if (all < squared_error_limit(seen)) return Agreement::full;
  const bool is_pixel_right = seen.has_disparity() && pixel < kInlierLimit2 && all - pixel > kGrossLimit1;
  return is_pixel_right ? Agreement::pixel : Agreement::none;
}

/// Returns the observation as if its disparity had not been measured.
[[nodiscard]] inline Observation without_disparity(Observation seen) {
  seen.d = std::numeric_limits<double>::quiet_NaN();
  return seen;
}

/// Judges an observation of a point (agreement_by).
[[nodiscard]] inline Agreement agreement(const Rig& rig, const Eigen::Vector3d& point_in_camera,
                                         const Observation& seen) {
  return agreement_by(squared_error(rig, point_in_camera, seen),
                      squared_error(rig, point_in_camera, without_disparity(seen)), seen);
}

}  // namespace cairn
