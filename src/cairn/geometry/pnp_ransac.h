// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/ransac.h"
#include "cairn/geometry/rig.h"

namespace cairn {

/// Holds the result of solve_pnp_ransac.
struct PnpResult : RansacReport {
  CameraFromWorld camera_from_world;
};

/// Estimates a camera pose from points and their observations by RANSAC: P3P (solve_p3p), scored by
/// squared_error with squared_error_limit, refined by Gauss-Newton steps on the inliers. With `keep_pixels` a
/// disparity adds at most what is between the limits with and without it, see PoseOptions. Throws
/// PreconditionError if the spans differ in length or a point or pixel is not finite.
[[nodiscard]] PnpResult solve_pnp_ransac(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const Observation> seen, const RansacOptions& options,
                                         bool keep_pixels = true);

/// Finds the observations that a given pose explains, of which a disparity may be wrong, and judges whether
/// so many would agree by chance with some pose: the status is ok, by_chance, or too_few_data if there are
/// fewer than three. Throws PreconditionError if the spans differ in length or a point or pixel is not
/// finite.
[[nodiscard]] RansacReport judge_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                      std::span<const Observation> seen,
                                      const CameraFromWorld& camera_from_world);

}  // namespace cairn
