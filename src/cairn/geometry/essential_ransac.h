// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/geometry/essential.h"
#include "cairn/geometry/ransac.h"

namespace cairn {

/// Estimates the essential matrix of two views by RANSAC: solve_five_point, scored by sampson_error with the
/// limit kInlierLimit1, refined by refine_essential. `a` and `b` are (x/z, y/z) of corresponding points, by
/// position; `sigma` is the standard deviation of their coordinates: that of pixels over the focal length.
/// The status is degenerate if the inliers do not determine a translation. The matrix has Frobenius norm
/// sqrt(2). Throws PreconditionError if the spans differ in length, a coordinate is not finite, or `sigma` is
/// not above 0.
[[nodiscard]] RansacResult<Eigen::Matrix3d> find_essential(std::span<const Eigen::Vector2d> a,
                                                           std::span<const Eigen::Vector2d> b, double sigma,
                                                           const RansacOptions& options);

}  // namespace cairn
