// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_start.h"

#include <algorithm>
#include <limits>

#include "cairn/geometry/triangulation.h"

namespace cairn {
namespace {

/// By disparity over its standard deviation.
bool is_surer(const Observation& a, const Observation& b) {
  return a.d * b.sigma_d_px > b.d * a.sigma_d_px || (a.has_disparity() && !b.has_disparity());
}

}  // namespace

void ObservationErrors::make_room(int blocks) {
  const auto size = static_cast<std::size_t>(blocks) * kObservationLanes;
  if (of_all.size() >= size) return;
  of_pixels.resize(size);
  of_all.resize(size);
  sorted.resize(size);
}

Eigen::Vector3d LandmarkStart::quick() const {
  std::size_t surest = 0;
  for (std::size_t i = 1; i < observations_.size(); ++i)
    if (is_surer(observations_[i].seen, observations_[surest].seen)) surest = i;
  constexpr double kFarDisparityPx = 1;  // for rays that do not meet in front of their cameras
  return candidate(surest).value_or(back_project(observations_[0], rig_.depth(kFarDisparityPx)));
}

Eigen::Vector3d LandmarkStart::robust(const LandmarkKernels& kernels, ObservationErrors& errors) const {
  constexpr std::size_t kMaxCandidates =
      64;  // one of them is right, unless nearly all observations are wrong
  const std::size_t stride = (observations_.size() + kMaxCandidates - 1) / kMaxCandidates;
  Eigen::Vector3d best = quick();
  double least = median_error(kernels, best, errors);
  for (std::size_t i = 0; i < observations_.size(); i += stride) {
    const auto point = candidate(i);
    if (!point) continue;
    const double error = median_error(kernels, *point, errors);
    if (!(error < least)) continue;
    least = error;
    best = *point;
  }
  return best;
}

std::optional<Eigen::Vector3d> LandmarkStart::candidate(std::size_t observation) const {
  const CameraObservation& chosen = observations_[observation];
  if (chosen.seen.d > 0) return back_project(chosen, rig_.depth(chosen.seen.d));
  const std::size_t count = observations_.size();
  return intersect(observation, (observation + count / 2) % count);
}

std::optional<Eigen::Vector3d> LandmarkStart::intersect(std::size_t a, std::size_t b) const {
  constexpr double kMinAngle = 1e-4;  // radians: a tenth of a pixel where a pixel is a thousandth
  const CameraObservation &seen_a = observations_[a], &seen_b = observations_[b];
  const PlacedCamera &camera_a = camera_of(seen_a), &camera_b = camera_of(seen_b);
  const Rigid3 b_from_a{
      Eigen::Quaterniond(camera_b.world_from_camera.transpose() * camera_a.world_from_camera),
      camera_b.world_from_camera.transpose() * (camera_a.centre_in_world - camera_b.centre_in_world)};
  const auto ray = [&](const Observation& seen) -> Eigen::Vector2d {
    return rig_.point_at(seen.u, seen.v, 1).head<2>();
  };
  const auto met = triangulate(b_from_a, ray(seen_a.seen), ray(seen_b.seen), kMinAngle);
  if (!met) return std::nullopt;
  return back_project(seen_a, met->point_in_a.z());
}

Eigen::Vector3d LandmarkStart::back_project(const CameraObservation& observation, double depth) const {
  const PlacedCamera& camera = camera_of(observation);
  return camera.world_from_camera * rig_.point_at(observation.seen.u, observation.seen.v, depth) +
         (camera.centre_in_world - packed_.origin_in_world());
}

double LandmarkStart::median_error(const LandmarkKernels& kernels, const Eigen::Vector3d& point,
                                   ObservationErrors& errors) const {
  LandmarkSums sums;
  kernels.linearise(packed_.blocks(), packed_.block_count(), point.data(), &sums, errors.of_pixels.data(),
                    errors.of_all.data());
  std::copy_n(errors.of_all.begin(), packed_.count(), errors.sorted.begin());
  const auto middle = errors.sorted.begin() + packed_.count() / 2;
  std::nth_element(errors.sorted.begin(), middle, errors.sorted.begin() + packed_.count());
  return *middle;
}

}  // namespace cairn
