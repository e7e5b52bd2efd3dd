// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/alignment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/decompositions.h"

namespace cairn {
namespace {

using Points = std::span<const Eigen::Vector3d>;

constexpr double kRelativeRank = 1e-10;  ///< below this share of the largest, a singular value is rounding

Eigen::Vector3d mean_of(Points points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// mean (a_i - mean_a) (b_i - mean_b)^T
Eigen::Matrix3d covariance(Points a, const Eigen::Vector3d& mean_a, Points b, const Eigen::Vector3d& mean_b) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b).transpose();
  return sum / static_cast<double>(a.size());
}

constexpr double kMaxCoordinate = 1e100;  ///< so that no square overflows

bool usable(Points points) {
  return std::all_of(points.begin(), points.end(), [](const Eigen::Vector3d& point) {
    return (point.array().abs() < kMaxCoordinate).all();  // false for NaN
  });
}

AlignmentStatus spread_of(const Eigen::Matrix3d& variance, const Eigen::Vector3d& mean) {
  const Eigen::Vector3d spreads = svd_of(variance).values;
  constexpr double kRounding = 1e-14;  // of coordinates
  if (std::sqrt(spreads[0]) <= kRounding * (mean.norm() + 1e-6)) return AlignmentStatus::one_place;
  // squared because these are variances, of which the square roots are lengths
  if (spreads[1] <= kRelativeRank * kRelativeRank * spreads[0]) return AlignmentStatus::one_line;
  return AlignmentStatus::ok;
}

/// Mean of the squared residuals' parts across `line`, a unit vector.
double squared_residual_across(const Eigen::Vector3d& line, const Similarity3& target_from_source,
                               Points source, Points target) {
  double sum = 0;
  for (std::size_t i = 0; i < source.size(); ++i)
    sum += line.cross(target[i] - target_from_source * source[i]).squaredNorm();
  return sum / static_cast<double>(source.size());
}

}  // namespace

double rms_distance(const Similarity3& target_from_source, Points source, Points target) {
  require(source.size() == target.size(), "points to compare correspond by position");
  if (source.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < source.size(); ++i)
    sum += (target[i] - target_from_source * source[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(source.size()));
}

Alignment align_points(Points source, Points target, bool with_scale) {
  require(source.size() == target.size(), "points to align correspond by position");
  require(usable(source) && usable(target), "coordinates of points to align are numbers below 1e100");
  if (source.size() < 3) return {};
  const Eigen::Vector3d source_mean = mean_of(source), target_mean = mean_of(target);
  const Eigen::Matrix3d source_variance = covariance(source, source_mean, source, source_mean);
  const Eigen::Matrix3d target_variance = covariance(target, target_mean, target, target_mean);
  Alignment result;
  result.status = spread_of(source_variance, source_mean);
  if (result.status == AlignmentStatus::ok) result.status = spread_of(target_variance, target_mean);
  if (result.status != AlignmentStatus::ok) return result;

  const Svd3 svd = svd_of(covariance(target, target_mean, source, source_mean));
  const Eigen::Vector3d& values = svd.values;
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.u.determinant() * svd.v.determinant() < 0) sign[2] = -1;
  const double corresponding = values[1] + sign[2] * values[2];
  if (corresponding <= kRelativeRank * values[0]) {
    result.status =
        values[1] <= kRelativeRank * values[0] ? AlignmentStatus::one_line : AlignmentStatus::mirrored;
    return result;
  }
  const Eigen::Matrix3d rotation = svd.u * sign.asDiagonal() * svd.v.transpose();
  Similarity3& found = result.target_from_source;
  if (with_scale) found.scale = values.dot(sign) / source_variance.trace();
  found.rotation = Eigen::Quaterniond(rotation).normalized();
  found.translation = target_mean - found.scale * (found.rotation * source_mean);
  result.rmse = rms_distance(found, source, target);
  // a turn by a small angle about the main line adds angle^2 * scale * corresponding to the mean square
  const double across = squared_residual_across(svd.u.col(0), found, source, target);
  result.turn_uncertainty = std::min(std::numbers::pi, std::sqrt(across / (found.scale * corresponding)));
  return result;
}

}  // namespace cairn
