// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/ransac.h"
#include "cairn/geometry/rig.h"

namespace cairn {

struct PnpResult : RansacReport {
  CameraFromWorld camera_from_world;
};

/// Camera pose from points and their observations in RANSAC: P3P (solve_p3p), scored by squared_error with
/// squared_error_limit, refined by Gauss-Newton steps on the inliers. PreconditionError for points and pixels
/// that are not finite.
[[nodiscard]] PnpResult solve_pnp_ransac(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                         std::span<const Observation> seen, const RansacOptions& options);

/// Which observations a pose from elsewhere explains, and whether so many would agree by chance with some
/// pose as well: status is ok, by_chance, or too_few_data for fewer than P3P takes. PreconditionError as
/// above.
[[nodiscard]] RansacReport judge_pose(const Rig& rig, std::span<const Eigen::Vector3d> points_in_world,
                                      std::span<const Observation> seen,
                                      const CameraFromWorld& camera_from_world);

}  // namespace cairn
