// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/homography.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/decompositions.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/point_pairs.h"

namespace cairn {
namespace {

using Points = std::span<const Eigen::Vector2d>;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// The two equations b x (h_3 a) - h_1 a = 0 and b_y (h_3 a) - h_2 a = 0, linear in H row by row.
Eigen::Matrix<double, 2, 9> equations_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  Eigen::Matrix<double, 2, 9> rows;
  rows << -a.x(), -a.y(), -1, 0, 0, 0, b.x() * a.x(), b.x() * a.y(), b.x(),  //
      0, 0, 0, -a.x(), -a.y(), -1, b.y() * a.x(), b.y() * a.y(), b.y();
  return rows;
}

/// Those equations' values, and their covariance where a and b have unit variance.
struct Residual {
  Eigen::Vector2d value;
  Eigen::Matrix2d covariance;
  double depth = 0;  ///< third coordinate of H (a, 1)
};

Residual residual_of(const Eigen::Matrix3d& H, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector3d mapped = H.leftCols<2>() * a + H.col(2);
  const Eigen::Matrix2d by_a = b * H.block<1, 2>(2, 0) - H.topLeftCorner<2, 2>();
  Residual residual;
  residual.depth = mapped.z();
  residual.value = b * mapped.z() - mapped.head<2>();
  residual.covariance = by_a * by_a.transpose();
  residual.covariance.diagonal().array() += mapped.z() * mapped.z();  // by b
  return residual;
}

/// Moves the points' centre to the origin and their mean distance from it to sqrt(2).
Eigen::Matrix3d normalisation_of(Points points, std::span<const std::int32_t> used) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const std::int32_t i : used) mean += points[static_cast<std::size_t>(i)];
  mean /= static_cast<double>(used.size());
  double distance = 0;
  for (const std::int32_t i : used) distance += (points[static_cast<std::size_t>(i)] - mean).norm();
  distance /= static_cast<double>(used.size());
  const double scale = distance > 0 ? std::numbers::sqrt2 / distance : 1.0;
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map.topLeftCorner<2, 2>() *= scale;
  map.topRightCorner<2, 1>() = -scale * mean;
  return map;
}

Eigen::Vector2d apply(const Eigen::Matrix3d& map, const Eigen::Vector2d& point) {
  return map.topLeftCorner<2, 2>() * point + map.topRightCorner<2, 1>();
}

Eigen::Matrix3d matrix_of(const Vector9d& row_by_row) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row_by_row.data());
}

/// Sign and norm as the header says, taken from one pair.
Eigen::Matrix3d standardised(const Eigen::Matrix3d& H, const Eigen::Vector2d& a) {
  const double sign = (H.row(2) * a.homogeneous()).value() < 0 ? -1.0 : 1.0;
  return sign / H.norm() * H;
}

double twice_area(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& r) {
  const Eigen::Vector2d u = q - p, v = r - p;
  return u.x() * v.y() - u.y() * v.x();
}

/// Each three of four points turn the same way in both views, and none lie on a line: else no homography maps
/// them with all in front of the camera (Marquez-Neila et al. 2015).
bool keeps_orientation(const std::array<Eigen::Vector2d, 4>& a, const std::array<Eigen::Vector2d, 4>& b) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4, k = (i + 2) % 4;
    if (!(twice_area(a[i], a[j], a[k]) * twice_area(b[i], b[j], b[k]) > 0)) return false;
  }
  return true;
}

/// The null space of the eight equations of four pairs.
Eigen::Matrix3d solve_four_point(const std::array<Eigen::Vector2d, 4>& a,
                                 const std::array<Eigen::Vector2d, 4>& b) {
  Eigen::Matrix<double, 9, 8> equations;
  for (int i = 0; i < 4; ++i)
    equations.middleCols<2>(2 * i) =
        equations_of(a[static_cast<std::size_t>(i)], b[static_cast<std::size_t>(i)]).transpose();
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 8>> qr(equations);
  const Vector9d h = qr.householderQ() * Vector9d::Unit(8);
  return standardised(matrix_of(h), a[0]);
}

struct HomographyProblem {
  using Model = Eigen::Matrix3d;
  static constexpr std::size_t kSampleSize = 4, kMaxModels = 1;

  Points a, b;
  double sigma = 1;

  [[nodiscard]] std::size_t size() const { return a.size(); }

  std::size_t solve(const std::array<std::uint32_t, kSampleSize>& sample,
                    std::array<Model, kMaxModels>& models) const {
    std::array<Eigen::Vector2d, kSampleSize> in_a, in_b;
    for (std::size_t i = 0; i < kSampleSize; ++i) {
      in_a[i] = a[sample[i]];
      in_b[i] = b[sample[i]];
    }
    if (!keeps_orientation(in_a, in_b)) return 0;
    models[0] = solve_four_point(in_a, in_b);
    return models[0].allFinite() ? 1 : 0;
  }

  [[nodiscard]] double squared_error(const Model& H, std::size_t i) const {
    return homography_sampson_error(H, a[i], b[i]) / (sigma * sigma);
  }
  [[nodiscard]] static double limit(std::size_t /*i*/) { return kInlierLimit2; }

  bool refine(std::span<const std::int32_t> inliers, Model& H) const {
    constexpr int kRepetitions = 2;
    for (int i = 0; i < kRepetitions; ++i) {
      const auto fitted = fit_homography(a, b, inliers, &H);
      if (!fitted) return false;
      H = *fitted;
    }
    return true;
  }

  /// A wrong b lies in the disc around the place where H has it; half of the squared error is made up in a.
  [[nodiscard]] double chance() const {
    return std::numbers::pi * 2.0 * kInlierLimit2 * sigma * sigma / extent_of(b).area;
  }
};

}  // namespace

double homography_sampson_error(const Eigen::Matrix3d& H, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  const Residual residual = residual_of(H, a, b);
  const double determinant = residual.covariance.determinant();
  if (!(residual.depth > 0) || !(determinant > 0)) return std::numeric_limits<double>::infinity();
  const double x = residual.value.x(), y = residual.value.y();
  const Eigen::Matrix2d& S = residual.covariance;
  return (S(1, 1) * x * x - 2.0 * S(0, 1) * x * y + S(0, 0) * y * y) / determinant;
}

std::optional<Eigen::Matrix3d> fit_homography(Points a, Points b, std::span<const std::int32_t> used,
                                              const Eigen::Matrix3d* weighting) {
  if (used.size() < 4) return std::nullopt;
  const Eigen::Matrix3d to_a = normalisation_of(a, used), to_b = normalisation_of(b, used);
  const Eigen::Matrix3d from_b = to_b.inverse();
  Eigen::Matrix3d normalised_weighting;
  if (weighting != nullptr) normalised_weighting = to_b * *weighting * to_a.inverse();
  Matrix9d sum = Matrix9d::Zero();
  for (const std::int32_t index : used) {
    const auto i = static_cast<std::size_t>(index);
    const Eigen::Vector2d p = apply(to_a, a[i]), q = apply(to_b, b[i]);
    const Eigen::Matrix<double, 2, 9> rows = equations_of(p, q);
    if (weighting == nullptr) {
      sum.noalias() += rows.transpose() * rows;
      continue;
    }
    const Eigen::Matrix2d weight = residual_of(normalised_weighting, p, q).covariance.inverse();
    if (weight.allFinite()) sum.noalias() += rows.transpose() * weight * rows;
  }
  const SymmetricEigen<9> eigen = eigen_of_symmetric(sum);
  constexpr double kRank = 1e-12;  // a second null vector: not determined
  if (!(eigen.values[1] > kRank * eigen.values[8])) return std::nullopt;
  const Eigen::Matrix3d H = from_b * matrix_of(eigen.vectors.col(0)) * to_a;
  if (!H.allFinite() || !(H.norm() > 0)) return std::nullopt;
  return standardised(H, a[static_cast<std::size_t>(used[0])]);
}

std::array<Rigid3, 4> decompose_homography(const Eigen::Matrix3d& homography) {
  require(homography.allFinite(), "the elements of a homography are finite");
  const SymmetricEigen<3> eigen = eigen_of_symmetric(Eigen::Matrix3d(homography.transpose() * homography));
  const double scale = std::sqrt(eigen.values[1]);
  const Eigen::Matrix3d H = homography / scale;
  const double largest = eigen.values[2] / (scale * scale);   // squared singular value, at least 1
  const double smallest = eigen.values[0] / (scale * scale);  // at most 1
  const Eigen::Vector3d v1 = eigen.vectors.col(2), v2 = eigen.vectors.col(1), v3 = eigen.vectors.col(0);
  std::array<Rigid3, 4> motions;
  for (std::size_t i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1 : -1;
    // a direction whose length H keeps, as it does that of v2: both lie in the plane seen from a
    const Eigen::Vector3d u =
        (std::sqrt(std::max(0.0, 1 - smallest)) * v1 + sign * std::sqrt(std::max(0.0, largest - 1)) * v3)
            .normalized();
    const Eigen::Vector3d normal = v2.cross(u);
    Eigen::Matrix3d before, after;
    before << v2, u, normal;
    after << H * v2, H * u, (H * v2).cross(H * u);
    const Eigen::Matrix3d R = after * before.transpose();
    const Eigen::Vector3d t = (H - R) * normal;
    const Eigen::Quaterniond rotation = Eigen::Quaterniond(R).normalized();
    motions[2 * i] = {rotation, t};
    motions[2 * i + 1] = {rotation, -t};
  }
  return motions;
}

RansacResult<Eigen::Matrix3d> find_homography(Points a, Points b, double sigma,
                                              const RansacOptions& options) {
  require_point_pairs(a, b, sigma);
  const HomographyProblem problem{a, b, sigma};
  return Ransac(problem, options).run();
}

}  // namespace cairn
