// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace cairn {

/// Throws PreconditionError unless `a` and `b` have one length, all points are finite, and `sigma` is above
/// 0.
void require_point_pairs(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                         double sigma);

/// Describes the bounding rectangle of points, over which outliers are assumed to be spread.
struct PlaneExtent {
  double diagonal = 0;
  double area = 0;
};
/// Computes the bounding rectangle of `points`; zero for no points.
[[nodiscard]] PlaneExtent extent_of(std::span<const Eigen::Vector2d> points);

}  // namespace cairn
