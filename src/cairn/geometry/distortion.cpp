// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/distortion.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kNearCentre = 1e-12;  // closer points are where they would be without distortion

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

/// The largest x in [0, end] up to which `holds`, which holds at 0 and, once it fails, fails for good.
template <class Predicate>
double bisect(double end, const Predicate& holds) {
  constexpr int kHalvings = 60;
  double low = 0, high = end;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

namespace radtan {
namespace {

bool rises_up_to_radius(const Distortion& k, double radius_squared) {
  return rises_up_to(radius_squared, {3.0 * k[0], 5.0 * k[1], 7.0 * k[4], 0.0});
}

double radial_factor(const Distortion& k, double radius_squared) {
  return 1.0 + radius_squared * (k[0] + radius_squared * (k[1] + radius_squared * k[4]));
}

/// Newton's method: any solution of distort(p) = distorted, not always the one next to the centre.
std::optional<Eigen::Vector2d> solve(const Distortion& k, const Eigen::Vector2d& distorted,
                                     Eigen::Vector2d p) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d error = distort(k, p) - distorted;
    if (error.squaredNorm() < 1e-26) return p;
    const Eigen::Matrix2d j = distort_by_point(k, p);
    const double determinant = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    if (!(std::abs(determinant) > 1e-9)) return std::nullopt;
    p -= Eigen::Vector2d(j(1, 1) * error.x() - j(0, 1) * error.y(),
                         j(0, 0) * error.y() - j(1, 0) * error.x()) /
         determinant;
  }
  if ((distort(k, p) - distorted).norm() < 1e-9) return p;
  return std::nullopt;
}

/// Where the radial distortion alone would have moved the point from.
Eigen::Vector2d undistort_radially(const Distortion& k, const Eigen::Vector2d& distorted) {
  constexpr double kFarthest = 100;  // 89.4 degrees
  const double distorted_radius = distorted.norm();
  const double radius = bisect(kFarthest, [&](double r) {
    return rises_up_to_radius(k, r * r) && r * radial_factor(k, r * r) < distorted_radius;
  });
  return distorted * (radius / distorted_radius);
}

}  // namespace

bool is_in_field(const Distortion& k, const Eigen::Vector2d& p) {
  return rises_up_to_radius(k, p.squaredNorm());
}

Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm();
  const double radial = radial_factor(k, r2);
  const double xy = p.x() * p.y();
  return {p.x() * radial + 2.0 * k[2] * xy + k[3] * (r2 + 2.0 * p.x() * p.x()),
          p.y() * radial + k[2] * (r2 + 2.0 * p.y() * p.y()) + 2.0 * k[3] * xy};
}

Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = radial_factor(k, r2);
  const double slope = k[0] + r2 * (2.0 * k[1] + 3.0 * r2 * k[4]);  // d radial / d r2
  Eigen::Matrix2d j;
  j(0, 0) = radial + 2.0 * x * x * slope + 2.0 * k[2] * y + 6.0 * k[3] * x;
  j(0, 1) = 2.0 * x * y * slope + 2.0 * k[2] * x + 2.0 * k[3] * y;
  j(1, 0) = j(0, 1);
  j(1, 1) = radial + 2.0 * y * y * slope + 6.0 * k[2] * y + 2.0 * k[3] * x;
  return j;
}

DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  DistortionJacobian j;
  j.row(0) << x * r2, x * r2 * r2, 2.0 * x * y, r2 + 2.0 * x * x, x * r2 * r2 * r2;
  j.row(1) << y * r2, y * r2 * r2, r2 + 2.0 * y * y, 2.0 * x * y, y * r2 * r2 * r2;
  return j;
}

std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted) {
  if (!distorted.allFinite()) return std::nullopt;
  auto p = solve(k, distorted, distorted);
  if (p && is_in_field(k, *p)) return p;
  p = solve(k, distorted, undistort_radially(k, distorted));  // near the field's end, or beyond it
  if (p && is_in_field(k, *p)) return p;
  return std::nullopt;
}

}  // namespace radtan

namespace kb4 {
namespace {

constexpr double kMaxTheta = 1.5533;  // 89 degrees

bool rises_up_to_angle(const Distortion& k, double theta) {
  return rises_up_to(theta * theta, {3.0 * k[0], 5.0 * k[1], 7.0 * k[2], 9.0 * k[3]});
}

double distorted_radius(const Distortion& k, double theta) {
  const double t2 = theta * theta;
  return theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
}

/// d distorted_radius / d theta.
double slope(const Distortion& k, double theta) {
  const double t2 = theta * theta;
  return 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
}

/// Newton's method; nothing where it leaves the field.
std::optional<double> solve_theta(const Distortion& k, double radius) {
  double theta = std::min(radius, kMaxTheta);
  for (int i = 0; i < 20; ++i) {
    const double rise = slope(k, theta);
    if (!(rise > 1e-6)) return std::nullopt;
    const double step = (distorted_radius(k, theta) - radius) / rise;
    theta -= step;
    if (!(theta >= 0 && theta <= kMaxTheta)) return std::nullopt;
    if (std::abs(step) < 1e-14) break;
  }
  if (std::abs(distorted_radius(k, theta) - radius) > 1e-12 || !rises_up_to_angle(k, theta))
    return std::nullopt;
  return theta;
}

std::optional<double> search_theta(const Distortion& k, double radius) {
  const double theta = bisect(kMaxTheta, [&](double angle) {
    return rises_up_to_angle(k, angle) && distorted_radius(k, angle) < radius;
  });
  if (std::abs(distorted_radius(k, theta) - radius) > 1e-12) return std::nullopt;
  return theta;
}

}  // namespace

bool is_in_field(const Distortion& k, const Eigen::Vector2d& p) {
  const double theta = std::atan(p.norm());
  return theta <= kMaxTheta && rises_up_to_angle(k, theta);
}

Eigen::Vector2d distort(const Distortion& k, const Eigen::Vector2d& p) {
  const double r = p.norm();
  if (r < kNearCentre) return p;
  return p * (distorted_radius(k, std::atan(r)) / r);
}

/// With s(r) = distorted_radius / r: s 1 + p p^T s'(r) / r.
Eigen::Matrix2d distort_by_point(const Distortion& k, const Eigen::Vector2d& p) {
  const double r2 = p.squaredNorm(), r = std::sqrt(r2);
  if (r < kNearCentre) return Eigen::Matrix2d::Identity();
  const double theta = std::atan(r);
  const double s = distorted_radius(k, theta) / r;
  const double s_slope_over_r = (slope(k, theta) / (1.0 + r2) - s) / r2;
  return s * Eigen::Matrix2d::Identity() + s_slope_over_r * p * p.transpose();
}

DistortionJacobian distort_by_coefficients(const Eigen::Vector2d& p) {
  DistortionJacobian j = DistortionJacobian::Zero();
  const double r = p.norm();
  if (r < kNearCentre) return j;
  const double theta = std::atan(r);
  double power = theta / r;
  for (int i = 0; i < 4; ++i) {
    power *= theta * theta;
    j.col(i) = power * p;
  }
  return j;
}

std::optional<Eigen::Vector2d> undistort(const Distortion& k, const Eigen::Vector2d& distorted) {
  const double radius = distorted.norm();
  if (!std::isfinite(radius)) return std::nullopt;
  if (radius < kNearCentre) return distorted;
  auto theta = solve_theta(k, radius);
  if (!theta) theta = search_theta(k, radius);
  if (!theta) return std::nullopt;
  return distorted * (std::tan(*theta) / radius);
}

}  // namespace kb4
}  // namespace cairn
