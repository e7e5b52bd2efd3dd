// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/indicators.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

ValueRange range_of(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  return {mean, *min, *max, std::sqrt(squares / count)};
}

/// Computes the largest angle by the chord between unit rays, which is exact for small angles; a cosine is
/// not.
double max_ray_angle_deg(const Eigen::Vector3d& point_in_world, std::span<const PosedObservation> views) {
  std::vector<Eigen::Vector3d> rays;
  for (const PosedObservation& view : views) {
    const Eigen::Vector3d centre_in_world = view.camera_from_world.inverse().translation;
    rays.push_back((centre_in_world - point_in_world).normalized());
  }
  double squared_chord = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      squared_chord = std::max(squared_chord, (rays[i] - rays[k]).squaredNorm());
  return 2 * std::asin(std::min(1.0, std::sqrt(squared_chord) / 2)) * kDegrees;
}

/// Computes the squared distance of pixel and projection; infinite if the point is not in front of the
/// camera.
double squared_distance_px(const Rig& rig, const Eigen::Vector3d& point_in_camera, const Observation& seen) {
  const Eigen::Vector3d projected = rig.project(point_in_camera);
  const double du = projected.x() - seen.u, dv = projected.y() - seen.v;
  return is_in_front(point_in_camera) ? du * du + dv * dv : std::numeric_limits<double>::infinity();
}

}  // namespace

LandmarkIndicators indicators_of(const Rig& rig, const Eigen::Vector3d& point_in_world,
                                 std::span<const PosedObservation> views) {
  require(!views.empty(), "a landmark is seen in one view at least");
  std::vector<double> distances, laterals, depths, angles;
  double squared_px = 0;
  for (const PosedObservation& view : views) {
    const Eigen::Vector3d point_in_camera = view.camera_from_world * point_in_world;
    const double lateral = std::hypot(point_in_camera.x(), point_in_camera.y());
    distances.push_back(point_in_camera.norm());
    laterals.push_back(lateral);
    depths.push_back(point_in_camera.z());
    angles.push_back(std::atan2(lateral, point_in_camera.z()) * kDegrees);
    squared_px += squared_distance_px(rig, point_in_camera, view.seen);
  }
  const auto count = static_cast<double>(views.size());
  return {static_cast<int>(views.size()),
          std::sqrt(squared_px / count),
          range_of(distances),
          range_of(laterals),
          range_of(depths),
          range_of(angles),
          max_ray_angle_deg(point_in_world, views)};
}

double largest_std(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

}  // namespace cairn
