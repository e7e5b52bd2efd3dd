// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"

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

/// Singular values of a set's variance: squared spreads along its main axes, the largest first.
Eigen::Vector3d squared_spreads(const Eigen::Matrix3d& variance) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(variance).singularValues();
}

AlignmentStatus status_of(const Eigen::Vector3d& spreads, const Eigen::Vector3d& mean) {
  constexpr double kRounding = 1e-14;  // of coordinates
  if (std::sqrt(spreads[0]) <= kRounding * (mean.norm() + 1e-6)) return AlignmentStatus::one_place;
  // squared because these are variances, of which the square roots are lengths
  if (spreads[1] <= kRelativeRank * kRelativeRank * spreads[0]) return AlignmentStatus::one_line;
  return AlignmentStatus::ok;
}

/// The part of the spread across the main line, of both sets, that corresponds.
double share_across(double corresponding, const Eigen::Vector3d& source, const Eigen::Vector3d& target) {
  const double across = std::sqrt((source[1] + source[2]) * (target[1] + target[2]));
  return std::clamp(corresponding / across, 0.0, 1.0);
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
  const Eigen::Vector3d source_spreads = squared_spreads(source_variance);
  const Eigen::Vector3d target_spreads =
      squared_spreads(covariance(target, target_mean, target, target_mean));
  Alignment result;
  result.status = status_of(source_spreads, source_mean);
  if (result.status == AlignmentStatus::ok) result.status = status_of(target_spreads, target_mean);
  if (result.status != AlignmentStatus::ok) return result;

  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance(target, target_mean, source, source_mean),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& values = svd.singularValues();
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign[2] = -1;
  const double corresponding = values[1] + sign[2] * values[2];
  if (corresponding <= kRelativeRank * values[0]) {
    result.status =
        values[1] <= kRelativeRank * values[0] ? AlignmentStatus::one_line : AlignmentStatus::mirrored;
    return result;
  }
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  Similarity3& found = result.target_from_source;
  if (with_scale) found.scale = values.dot(sign) / source_variance.trace();
  found.rotation = Eigen::Quaterniond(rotation).normalized();
  found.translation = target_mean - found.scale * (found.rotation * source_mean);
  result.rmse = rms_distance(found, source, target);
  result.turn_support = share_across(corresponding, source_spreads, target_spreads);
  return result;
}

}  // namespace cairn
