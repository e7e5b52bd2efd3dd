// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cairn/geometry/essential.h"
#include "cairn/geometry/framed.h"
#include "cairn/geometry/ransac.h"
#include "cairn/geometry/triangulation.h"
#include "cairn/geometry/two_view_choice.h"

namespace cairn {

struct TwoViewOptions {
  RansacOptions ransac{.max_iterations = 2000};  ///< 30 % inliers: 1 - (1 - 0.3^5)^2000 = 99 %
  double min_angle = 0.01;  ///< radians between the rays of a triangulated point; below, its depth is a guess
  double min_in_front = 0.75;  ///< share of the inliers in front of both cameras
  double max_rival = 0.7;      ///< share of these that a second motion may have in front
};

enum class TwoViewStatus {
  ok,
  too_few_points,    ///< fewer than five
  no_model,          ///< no model, or one that wrong pairs would support as well
  no_translation,    ///< the camera only turned
  ambiguous_motion,  ///< no motion, or several, have the points in front of both cameras
  no_depth,          ///< the rays meet at too small an angle
};

[[nodiscard]] std::string_view to_string(TwoViewStatus status);

struct TwoViewPoint {
  std::int32_t pair = 0;  ///< position in `a` and `b`
  TriangulatedPoint triangulated;
};

/// Up to scale, as two views do not show it.
using BFromA = Transform<frame::ViewB, frame::ViewA>;

/// A possible motion and how many of the inliers it sees from both sides of the baseline as it should.
struct TwoViewMotion {
  BFromA b_from_a;           ///< translation of length 1
  std::size_t in_front = 0;  ///< inliers in front of both cameras, their rays at min_angle or more
  std::size_t parted = 0;    ///< inliers whose rays meet at min_angle or more, wherever
};

struct TwoViewResult {
  TwoViewStatus status = TwoViewStatus::too_few_points;
  RansacResult<Eigen::Matrix3d> essential, homography;
  ModelChoice choice;
  std::array<TwoViewMotion, 4> motions;  ///< of the chosen model's matrix; all the identity for a rotation
  std::size_t motion = 0;                ///< the one with most inliers in front
  BFromA b_from_a;                       ///< that one; for a rotation, the rotation
  std::vector<TwoViewPoint> points;      ///< inliers in front, in the unit of the translation
};

/// Relative motion and points of two views: essential matrix and homography in RANSAC, the choice between
/// them (choose_model), the motion of the chosen matrix that has most inliers in front of both cameras, and
/// these triangulated. `a` and `b` are (x/z, y/z), `sigma` the standard deviation of their coordinates. A
/// plane allows for two motions; status is ambiguous_motion where both have the points in front.
/// PreconditionError as for find_essential.
[[nodiscard]] TwoViewResult reconstruct_two_views(std::span<const Eigen::Vector2d> a,
                                                  std::span<const Eigen::Vector2d> b, double sigma,
                                                  const TwoViewOptions& options = {});

/// The median ratio of measured to triangulated depth, and what it rests on.
struct MetricScale {
  std::size_t points = 0;      ///< with a measured depth; the scale is determined where there is one
  double metres_per_unit = 0;  ///< of the two views' translation
  double relative_mad =
      0;  ///< relative: 1.4826 times the median absolute deviation of the ratios over the median
};

/// `depths_in_a` are metres along the optical axis at each of the points, not above 0 where unknown.
[[nodiscard]] MetricScale metric_scale(std::span<const TwoViewPoint> points,
                                       std::span<const double> depths_in_a);

}  // namespace cairn
