// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/precision.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/geometry/pose_equations.h"

namespace cairn {
namespace {

/// Quantiles of the normal distribution for 1e-3: two-sided, and one-sided for what an inlier test misses.
constexpr double kTwoSided = 3.291, kOneSided = 3.090;

Matrix6d unit_cofactor(const Rig& rig, const Correspondences& correspondences, const PoseEstimate& pose) {
  Matrix6d information = Matrix6d::Zero();
  for (const std::int32_t index : pose.inliers) {
    const auto i = static_cast<std::size_t>(index);
    Eigen::Matrix<double, 3, 6> jacobian =
        observation_jacobian(rig, pose.camera_from_world * correspondences.points_in_world[i]);
    if (!correspondences.observations[i].has_disparity()) jacobian.row(2).setZero();
    information.noalias() += jacobian.transpose() * jacobian;
  }
  return information.ldlt().solve(Matrix6d::Identity());
}

/// Computes by how much an axis can be off because of one inlier that is wrong unnoticed. The test of
/// observation i sees the share 1 - h of its error, h being its leverage; so an error of (limit + k) / (1 -
/// h) standard deviations is missed with the probability of k at most, and moves the pose by the gain times
/// that.
Vector6d unnoticed_error(const Rig& rig, const Correspondences& correspondences, const PoseEstimate& pose) {
  Vector6d largest = Vector6d::Zero();
  for (const std::int32_t index : pose.inliers) {
    const auto i = static_cast<std::size_t>(index);
    const Observation& seen = correspondences.observations[i];
    const WhitenedError whitened = whiten(rig, pose.camera_from_world, correspondences.points_in_world[i],
                                          seen, correspondences.covariances[i]);
    const Eigen::Matrix<double, 6, 3> gain = pose.covariance * whitened.jacobian.transpose();
    constexpr double kMostLeverage = 0.999;
    const double leverage = std::min(kMostLeverage, (whitened.jacobian * gain).trace());
    const double missed = (std::sqrt(squared_error_limit(seen)) + kOneSided) / (1 - leverage);
    largest = largest.cwiseMax(gain.rowwise().norm() * missed);
  }
  return largest;
}

}  // namespace

Precision assess_precision(const Rig& rig, const Correspondences& given, const PoseEstimate& pose,
                           NoiseScale noise) {
  require(pose.found(), "the precision of a pose that was found");
  require(given.covariances.size() == given.size(), "each point has a covariance");
  std::vector<Observation> used(given.observations.begin(), given.observations.end());
  for (const std::int32_t i : pose.wrong_disparities)
    used[static_cast<std::size_t>(i)] = without_disparity(used[static_cast<std::size_t>(i)]);
  const Correspondences correspondences{given.points_in_world, used, given.covariances};
  Precision precision;
  const double scale = std::max(1.0, pose.variance_factor);
  precision.covariance = (noise == NoiseScale::as_residuals ? pose.variance_factor : scale) * pose.covariance;
  precision.dilution = unit_cofactor(rig, correspondences, pose).diagonal().cwiseMax(0.0).cwiseSqrt();
  precision.gdop = precision.dilution.tail<3>().norm();
  const Vector6d sigma = precision.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  precision.protection = kTwoSided * sigma + std::sqrt(scale) * unnoticed_error(rig, correspondences, pose);
  return precision;
}

void add_common_error(const CommonError& error, const Eigen::Quaterniond& camera_from_keyframe,
                      Precision& precision) {
  const auto sigma = [](const Matrix6d& covariance) -> Vector6d {
    return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  };
  const Matrix6d by_noise = precision.covariance;
  precision.covariance = by_noise + turned(error.to_map, camera_from_keyframe);
  precision.absolute = by_noise + turned(error.to_world, camera_from_keyframe);
  precision.protection += kTwoSided * (sigma(precision.covariance) - sigma(by_noise));
}

}  // namespace cairn
