// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/point_pairs.h"

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

bool all_finite(std::span<const Eigen::Vector2d> points) {
  return std::all_of(points.begin(), points.end(), [](const Eigen::Vector2d& p) { return p.allFinite(); });
}

}  // namespace

void require_point_pairs(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                         double sigma) {
  require(a.size() == b.size(), "points of two views correspond by position");
  require(all_finite(a) && all_finite(b), "coordinates of points are finite");
  require(sigma > 0 && sigma < 1e100, "the standard deviation is a number above 0");
}

PlaneExtent extent_of(std::span<const Eigen::Vector2d> points) {
  if (points.empty()) return {};
  Eigen::Vector2d low = points[0], high = points[0];
  for (const auto& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2d size = high - low;
  return {size.norm(), size.x() * size.y()};
}

}  // namespace cairn
