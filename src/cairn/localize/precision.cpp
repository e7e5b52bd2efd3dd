// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/precision.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

/// 1e-3 two-sided, and one-sided for what an inlier test misses.
constexpr double kTwoSided = 3.291, kOneSided = 3.090;

Matrix6d unit_cofactor(const Rig& rig, std::span<const Sight> sights, const Resection& resection) {
  Matrix6d information = Matrix6d::Zero();
  for (const std::int32_t index : resection.inliers) {
    const Sight& sight = sights[static_cast<std::size_t>(index)];
    Eigen::Matrix<double, 3, 6> jacobian =
        observation_jacobian(rig, resection.camera_from_world * sight.point_in_world);
    if (!sight.seen.has_disparity()) jacobian.row(2).setZero();
    information.noalias() += jacobian.transpose() * jacobian;
  }
  return information.ldlt().solve(Matrix6d::Identity());
}

/// By how much an axis can be off because of one inlier that is wrong unnoticed. The test of observation i
/// sees the share 1 - h of its error, h being its leverage; so an error of (limit + k) / (1 - h) standard
/// deviations is missed with the probability of k at most, and moves the pose by the gain times that.
Vector6d unnoticed_error(const Rig& rig, std::span<const Sight> sights, const Resection& resection) {
  Vector6d largest = Vector6d::Zero();
  for (const std::int32_t index : resection.inliers) {
    const Sight& sight = sights[static_cast<std::size_t>(index)];
    const WhitenedSight whitened = whiten(rig, resection.camera_from_world, sight);
    const Eigen::Matrix<double, 6, 3> gain = resection.covariance * whitened.jacobian.transpose();
    constexpr double kMostLeverage = 0.999;
    const double leverage = std::min(kMostLeverage, (whitened.jacobian * gain).trace());
    const double missed = (std::sqrt(squared_error_limit(sight.seen)) + kOneSided) / (1 - leverage);
    largest = largest.cwiseMax(gain.rowwise().norm() * missed);
  }
  return largest;
}

}  // namespace

Precision assess_precision(const Rig& rig, std::span<const Sight> sights, const Resection& resection) {
  require(resection.solved, "the precision of a pose that was found");
  Precision precision;
  const double scale = std::max(1.0, resection.variance_factor);
  precision.covariance = scale * resection.covariance;
  precision.dilution = unit_cofactor(rig, sights, resection).diagonal().cwiseMax(0.0).cwiseSqrt();
  precision.gdop = precision.dilution.tail<3>().norm();
  const Vector6d sigma = precision.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  precision.protection = kTwoSided * sigma + std::sqrt(scale) * unnoticed_error(rig, sights, resection);
  return precision;
}

}  // namespace cairn
