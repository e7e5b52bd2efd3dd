// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/alignment.h"
#include "cairn/geometry/ransac.h"

namespace cairn {

/// align_points in RANSAC, for correspondences of which some are wrong: samples of three, scored by squared
/// distance over `sigma`^2, sigma the standard deviation of each coordinate of target_i - target_from_source
/// source_i in the target's unit, with kInlierLimit3 as limit; refined by align_points over the inliers.
/// status is degenerate if all inliers lie on one line. PreconditionError as for align_points.
[[nodiscard]] RansacResult<Similarity3> align_points_ransac(std::span<const Eigen::Vector3d> source,
                                                            std::span<const Eigen::Vector3d> target,
                                                            bool with_scale, double sigma,
                                                            const RansacOptions& options);

}  // namespace cairn
