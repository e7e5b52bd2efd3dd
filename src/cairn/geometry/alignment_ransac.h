// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/alignment.h"
#include "cairn/geometry/ransac.h"

namespace cairn {

/// Estimates the similarity of two point sets with outliers: RANSAC over samples of three, scored by squared
/// distance over `sigma`^2 with the limit kInlierLimit3, refined by align_points on the inliers. `sigma` is
/// the standard deviation of each coordinate of target_i - target_from_source source_i in the target's unit.
/// The status is degenerate if all inliers lie on one line. Throws PreconditionError if the spans differ in
/// length, a coordinate is not a number below 1e100, or `sigma` is not above 0.
[[nodiscard]] RansacResult<Similarity3> align_points_ransac(std::span<const Eigen::Vector3d> source,
                                                            std::span<const Eigen::Vector3d> target,
                                                            bool with_scale, double sigma,
                                                            const RansacOptions& options);

}  // namespace cairn
