// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/essential.h"
#include "cairn/geometry/ransac.h"

namespace cairn {

/// The essential matrix of two views in RANSAC: solve_five_point, scored by sampson_error with kInlierLimit1
/// as limit, refined by refine_essential. `a` and `b` are (x/z, y/z) of corresponding points, by position;
/// `sigma` the standard deviation of their coordinates: that of pixels over the focal length. status is
/// degenerate where the inliers do not determine a translation. The matrix has Frobenius norm sqrt(2).
/// PreconditionError for numbers that are not finite.
[[nodiscard]] RansacResult<Eigen::Matrix3d> find_essential(std::span<const Eigen::Vector2d> a,
                                                           std::span<const Eigen::Vector2d> b, double sigma,
                                                           const RansacOptions& options);

}  // namespace cairn
