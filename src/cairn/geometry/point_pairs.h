// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace cairn {

/// PreconditionError unless there are as many `b` as `a`, all finite, and `sigma` is above 0.
void require_point_pairs(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                         double sigma);

/// The smallest upright rectangle around points: what a wrong point is taken to be spread over.
struct PlaneExtent {
  double diagonal = 0;
  double area = 0;
};
[[nodiscard]] PlaneExtent extent_of(std::span<const Eigen::Vector2d> points);

}  // namespace cairn
