// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/observed_frame.h"

#include <limits>
#include <utility>

#include "cairn/core/median.h"

namespace cairn {

Eigen::Vector3d point_in_camera(const Rig& rig, const Observation& seen) {
  if (!seen.has_disparity()) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return rig.point_at(seen.u, seen.v, rig.depth(seen.d));
}

void correct_disparity(const Rig& rig, const DisparityField& field, double min_sigmas, Observation& seen) {
  seen.d -= field.dot(disparity_field_basis(rig, seen.u));
  if (!(seen.d > 0 && seen.d > min_sigmas * seen.sigma_d_px))
    seen.d = std::numeric_limits<double>::quiet_NaN();
}

void correct_disparities(const Rig& rig, const DisparityField& field, double min_sigmas,
                         ObservedFrame& frame) {
  for (std::size_t i = 0; i < frame.observations.size(); ++i) {
    Observation& seen = frame.observations[i];
    if (!seen.has_disparity()) continue;
    correct_disparity(rig, field, min_sigmas, seen);
    frame.points_in_camera[i] = point_in_camera(rig, seen);
  }
}

void weigh_disparities(const Rig& rig, const DisparityNoise& noise, ObservedFrame& frame) {
  for (Observation& seen : frame.observations)
    if (seen.has_disparity()) seen.sigma_d_px = noise.at(rig, seen.d);
}

double median_depth(const ObservedFrame& frame) {
  std::vector<double> depths;
  for (const Eigen::Vector3d& point : frame.points_in_camera)
    if (point.allFinite()) depths.push_back(point.z());
  if (depths.empty()) return std::numeric_limits<double>::quiet_NaN();
  return median(std::move(depths));
}

}  // namespace cairn
