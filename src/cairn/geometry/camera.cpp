// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/camera.h"

#include <cmath>

namespace cairn {
namespace {

constexpr double kMinDepth = 1e-9;

/// True where 1 + c0 x + c1 x^2 + c2 x^3 + c3 x^4, the slope of the distorted over the undistorted radius, is
/// above 0 from 0 to x. Beyond its first zero the image folds back, and a point far outside the field of view
/// would fall on a pixel within it. Looks at points a fifth apart, down to where the absolute values of the
/// terms rule a zero out.
bool rises_up_to(double x, const std::array<double, 4>& c) {
  if (!std::isfinite(x)) return false;
  const auto sum = [&](double a, double b, double d, double e) {
    return x * (a + x * (b + x * (d + x * e)));
  };
  while (sum(std::abs(c[0]), std::abs(c[1]), std::abs(c[2]), std::abs(c[3])) >= 1.0) {
    if (!(1.0 + sum(c[0], c[1], c[2], c[3]) > 0)) return false;
    x *= 0.8;
  }
  return true;
}

/// Tangential terms left out: they are small.
bool radtan_rises_up_to(const std::array<double, 5>& d, double radius_squared) {
  return rises_up_to(radius_squared, {3.0 * d[0], 5.0 * d[1], 7.0 * d[4], 0.0});
}

bool kb4_rises_up_to(const std::array<double, 5>& d, double theta) {
  return rises_up_to(theta * theta, {3.0 * d[0], 5.0 * d[1], 7.0 * d[2], 9.0 * d[3]});
}

/// OpenCV's documentation of calib3d, "Detailed description": radial and tangential distortion.
Eigen::Vector2d distort_radtan(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2.0 * d[2] * xy + d[3] * (r2 + 2.0 * p.x() * p.x()),
          p.y() * radial + d[2] * (r2 + 2.0 * p.y() * p.y()) + 2.0 * d[3] * xy};
}

Eigen::Matrix2d distort_radtan_jacobian(const std::array<double, 5>& d, const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double slope = d[0] + r2 * (2.0 * d[1] + 3.0 * r2 * d[4]);  // d radial / d r2
  Eigen::Matrix2d j;
  j(0, 0) = radial + 2.0 * x * x * slope + 2.0 * d[2] * y + 6.0 * d[3] * x;
  j(0, 1) = 2.0 * x * y * slope + 2.0 * d[2] * x + 2.0 * d[3] * y;
  j(1, 0) = j(0, 1);
  j(1, 1) = radial + 2.0 * y * y * slope + 6.0 * d[2] * y + 2.0 * d[3] * x;
  return j;
}

/// Any solution of distort_radtan(p) = distorted, not always the one next to the centre.
std::optional<Eigen::Vector2d> solve_radtan(const std::array<double, 5>& d,
                                            const Eigen::Vector2d& distorted) {
  Eigen::Vector2d p = distorted;
  for (int i = 0; i < 20; ++i) {  // Newton
    const Eigen::Vector2d error = distort_radtan(d, p) - distorted;
    if (error.squaredNorm() < 1e-24) return p;
    const Eigen::Matrix2d j = distort_radtan_jacobian(d, p);
    const double determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    if (std::abs(determinant) < 1e-6) return std::nullopt;
    p -= Eigen::Vector2d(j(1, 1) * error.x() - j(0, 1) * error.y(),
                         j(0, 0) * error.y() - j(1, 0) * error.x()) /
         determinant;
  }
  if ((distort_radtan(d, p) - distorted).norm() < 1e-9) return p;
  return std::nullopt;
}

std::optional<Eigen::Vector2d> undistort_radtan(const std::array<double, 5>& d,
                                                const Eigen::Vector2d& distorted) {
  auto p = solve_radtan(d, distorted);
  if (p && radtan_rises_up_to(d, p->squaredNorm())) return p;
  return std::nullopt;
}

/// Kannala and Brandt 2006, eq. 6 with the odd powers up to 9.
double kb4_radius(const std::array<double, 5>& d, double theta) {
  const double t2 = theta * theta;
  return theta * (1.0 + t2 * (d[0] + t2 * (d[1] + t2 * (d[2] + t2 * d[3]))));
}

double kb4_slope(const std::array<double, 5>& d, double theta) {
  const double t2 = theta * theta;
  return 1.0 + t2 * (3.0 * d[0] + t2 * (5.0 * d[1] + t2 * (7.0 * d[2] + t2 * 9.0 * d[3])));
}

std::optional<Eigen::Vector2d> undistort_kb4(const std::array<double, 5>& d,
                                             const Eigen::Vector2d& distorted) {
  const double radius = distorted.norm();
  if (radius < 1e-12) return distorted;
  double theta = radius;
  for (int i = 0; i < 30; ++i) {
    const double slope = kb4_slope(d, theta);
    if (slope < 1e-6) return std::nullopt;
    const double step = (kb4_radius(d, theta) - radius) / slope;
    theta -= step;
    if (std::abs(step) < 1e-13) break;
  }
  constexpr double kMaxTheta = 1.5533;  // 89 degrees: beyond, no finite (x/z, y/z)
  if (theta < 0 || theta > kMaxTheta || std::abs(kb4_radius(d, theta) - radius) > 1e-9) return std::nullopt;
  if (!kb4_rises_up_to(d, theta)) return std::nullopt;
  return distorted * (std::tan(theta) / radius);
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
  if (!(point_in_camera.z() > kMinDepth)) return std::nullopt;
  Eigen::Vector2d p = point_in_camera.head<2>() / point_in_camera.z();
  if (model == CameraModel::radtan) {
    if (!radtan_rises_up_to(distortion, p.squaredNorm())) return std::nullopt;
    p = distort_radtan(distortion, p);
  } else if (model == CameraModel::kb4) {
    const double r = p.norm();
    const double theta = std::atan(r);
    if (!kb4_rises_up_to(distortion, theta)) return std::nullopt;
    if (r > 1e-12) p *= kb4_radius(distortion, theta) / r;
  }
  return Eigen::Vector2d(fx * p.x() + cx, fy * p.y() + cy);
}

std::optional<Eigen::Vector2d> Camera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (model == CameraModel::radtan) return undistort_radtan(distortion, p);
  if (model == CameraModel::kb4) return undistort_kb4(distortion, p);
  return p;
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
