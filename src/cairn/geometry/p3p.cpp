// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/p3p.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace cairn {
namespace {

using Points = std::array<Eigen::Vector3d, 3>;

/// The triangle's sides and the angles under which the camera sees them: side[i] lies opposite point i.
struct Triangle {
  Eigen::Vector3d side_squared;
  Eigen::Vector3d cosine;
};

Triangle triangle_of(const Points& points, const Points& rays) {
  return {{(points[1] - points[2]).squaredNorm(), (points[0] - points[2]).squaredNorm(),
           (points[0] - points[1]).squaredNorm()},
          {rays[1].dot(rays[2]), rays[0].dot(rays[2]), rays[0].dot(rays[1])}};
}

/// Haralick et al. 1994, eq. 9: the quartic in v = s3 / s1.
std::array<double, 5> grunert_quartic(const Triangle& t) {
  const double a = t.side_squared.x() / t.side_squared.y();  // a^2 / b^2
  const double c = t.side_squared.z() / t.side_squared.y();  // c^2 / b^2
  const double ca = t.cosine.x(), cb = t.cosine.y(), cg = t.cosine.z();
  const double difference = a - c, sum = a + c;
  return {(1 + difference) * (1 + difference) - 4 * a * cg * cg,
          4 * (-difference * (1 + difference) * cb + 2 * a * cg * cg * cb - (1 - sum) * ca * cg),
          2 * (difference * difference - 1 + 2 * difference * difference * cb * cb + 2 * (1 - c) * ca * ca -
               4 * sum * ca * cb * cg + 2 * (1 - a) * cg * cg),
          4 * (difference * (1 - difference) * cb - (1 - sum) * ca * cg + 2 * c * ca * ca * cb),
          (difference - 1) * (difference - 1) - 4 * c * ca * ca};
}

/// Newton steps on the three laws of cosines, s_i^2 + s_j^2 - 2 s_i s_j cos = side^2.
bool polish_distances(const Triangle& t, Eigen::Vector3d& s) {
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Eigen::Vector3d error(
        s.y() * s.y() + s.z() * s.z() - 2 * s.y() * s.z() * t.cosine.x() - t.side_squared.x(),
        s.x() * s.x() + s.z() * s.z() - 2 * s.x() * s.z() * t.cosine.y() - t.side_squared.y(),
        s.x() * s.x() + s.y() * s.y() - 2 * s.x() * s.y() * t.cosine.z() - t.side_squared.z());
    Eigen::Matrix3d jacobian;
    jacobian << 0, s.y() - s.z() * t.cosine.x(), s.z() - s.y() * t.cosine.x(),  //
        s.x() - s.z() * t.cosine.y(), 0, s.z() - s.x() * t.cosine.y(),          //
        s.x() - s.y() * t.cosine.z(), s.y() - s.x() * t.cosine.z(), 0;
    bool invertible = false;
    Eigen::Matrix3d inverse;
    jacobian.computeInverseWithCheck(inverse, invertible, 1e-12);
    if (!invertible) return false;
    s -= 0.5 * inverse * error;
  }
  return s.allFinite() && (s.array() > 0).all();
}

/// An orthonormal frame fixed to the triangle; its columns. The points are not on one line.
Eigen::Matrix3d frame_of(const Points& p) {
  Eigen::Matrix3d frame;
  frame.col(0) = (p[1] - p[0]).normalized();
  frame.col(2) = frame.col(0).cross(p[2] - p[0]).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

Rigid3 align_triangles(const Points& in_world, const Points& in_camera) {
  const Eigen::Matrix3d rotation = frame_of(in_camera) * frame_of(in_world).transpose();
  const Eigen::Vector3d world_centre = (in_world[0] + in_world[1] + in_world[2]) / 3;
  const Eigen::Vector3d camera_centre = (in_camera[0] + in_camera[1] + in_camera[2]) / 3;
  return {Eigen::Quaterniond(rotation).normalized(), camera_centre - rotation * world_centre};
}

bool on_one_line(const Points& p) {
  const Eigen::Vector3d a = p[1] - p[0], b = p[2] - p[0];
  return a.cross(b).squaredNorm() <= 1e-12 * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

std::size_t solve_quartic(const std::array<double, 5>& c, std::array<double, 4>& roots) {
  if (!(std::abs(c[4]) > 1e-14)) return 0;
  // Durand-Kerner: all four roots at once, from points on a circle; 4 * 20 complex steps are 1 microsecond.
  using Complex = std::complex<double>;
  std::array<Complex, 5> monic;
  for (std::size_t i = 0; i < 5; ++i) monic[i] = c[i] / c[4];
  const auto value = [&](Complex x) {
    return (((x + monic[3]) * x + monic[2]) * x + monic[1]) * x + monic[0];
  };
  const Complex start(0.4, 0.9);
  const double radius =
      1.0 +
      std::sqrt(std::max({std::abs(monic[0]), std::abs(monic[1]), std::abs(monic[2]), std::abs(monic[3])}));
  std::array<Complex, 4> z{radius * 0.5, radius * 0.5 * start, radius * 0.5 * start * start,
                           radius * 0.5 * start * start * start};
  for (int iteration = 0; iteration < 60; ++iteration) {
    double largest_step = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      Complex product = 1;
      for (std::size_t j = 0; j < 4; ++j) product *= i == j ? Complex(1) : z[i] - z[j];
      const Complex step = value(z[i]) / product;
      z[i] -= step;
      largest_step = std::max(largest_step, std::abs(step));
    }
    if (!(largest_step > 1e-13 * radius)) break;
  }
  std::size_t count = 0;
  for (const Complex& root : z) {
    if (std::abs(root.imag()) > 1e-4 * (1 + std::abs(root.real())) || !std::isfinite(root.real())) continue;
    roots[count++] = root.real();
  }
  return count;
}

P3pSolutions solve_p3p(const Points& points_in_world, const Points& rays) {
  P3pSolutions solutions;
  if (on_one_line(points_in_world)) return solutions;
  const Triangle t = triangle_of(points_in_world, rays);
  std::array<double, 4> roots{};
  const std::size_t root_count = solve_quartic(grunert_quartic(t), roots);
  const double difference = (t.side_squared.x() - t.side_squared.z()) / t.side_squared.y();
  for (std::size_t i = 0; i < root_count; ++i) {
    const double v = roots[i];
    const double denominator = 2 * (t.cosine.z() - v * t.cosine.x());
    const double s1_squared = t.side_squared.y() / (1 + v * v - 2 * v * t.cosine.y());
    if (!(v > 0) || std::abs(denominator) < 1e-12 || !(s1_squared > 0)) continue;
    const double u =
        ((difference - 1) * v * v - 2 * difference * t.cosine.y() * v + 1 + difference) / denominator;
    if (!(u > 0)) continue;
    Eigen::Vector3d distances = std::sqrt(s1_squared) * Eigen::Vector3d(1, u, v);
    if (!polish_distances(t, distances)) continue;
    const Points in_camera{rays[0] * distances.x(), rays[1] * distances.y(), rays[2] * distances.z()};
    solutions.camera_from_world[solutions.count++] = align_triangles(points_in_world, in_camera);
  }
  return solutions;
}

}  // namespace cairn
