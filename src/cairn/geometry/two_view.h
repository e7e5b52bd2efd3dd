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

/// Sets how the motion between two views is sought and accepted.
struct TwoViewOptions {
  RansacOptions ransac{.max_iterations = 2000};  ///< 30 % inliers: 1 - (1 - 0.3^5)^2000 = 99 %
  /// Minimum angle between the rays of a triangulated point, radians; below, its depth is a guess.
  double min_angle = 0.01;
  /// Minimum share in front of both cameras, of the inliers whose rays meet at min_angle or more.
  double min_in_front = 0.75;
  /// Maximum points in front of both cameras of a second motion, as a share of those of the best.
  double max_rival = 0.7;
};

/// Says if a motion was found and, if not, why.
enum class TwoViewStatus {
  ok,
  too_few_points,    ///< fewer than five
  no_model,          ///< no model, or one that wrong pairs would support as well
  no_translation,    ///< the camera only rotated
  ambiguous_motion,  ///< no motion, or more than one, has the points in front of both cameras
  no_depth,          ///< the rays meet at too small an angle
};

[[nodiscard]] std::string_view to_string(TwoViewStatus status);

/// Holds a triangulated pair.
struct TwoViewPoint {
  std::int32_t pair = 0;  ///< position in `a` and `b`
  TriangulatedPoint triangulated;
};

/// Motion between two views, up to scale, since two views do not determine it.
using BFromA = Transform<frame::ViewB, frame::ViewA>;

/// Describes a possible motion and how many inliers support it.
struct TwoViewMotion {
  BFromA b_from_a;           ///< translation of length 1
  std::size_t in_front = 0;  ///< inliers in front of both cameras, their rays at min_angle or more
  std::size_t parted = 0;    ///< inliers whose rays meet at min_angle or more, also behind a camera
};

/// Holds the result of reconstruct_two_views.
struct TwoViewResult {
  TwoViewStatus status = TwoViewStatus::too_few_points;
  RansacResult<Eigen::Matrix3d> essential, homography;
  ModelChoice choice;
  std::array<TwoViewMotion, 4> motions;  ///< of the chosen model's matrix; all the identity for a rotation
  std::size_t motion = 0;                ///< index of the motion with most inliers in front
  BFromA b_from_a;                       ///< the chosen motion; if the camera only rotated, the rotation
  std::vector<TwoViewPoint> points;      ///< inliers in front of both cameras, in the unit of the translation
};

/// Reconstructs the relative motion and the points of two views: essential matrix and homography by RANSAC,
/// the choice between them (choose_model), the motion of the chosen matrix that has most inliers in front of
/// both cameras, and these triangulated. `a` and `b` are (x/z, y/z), `sigma` is the standard deviation of
/// their coordinates. A plane allows for two motions; the status is ambiguous_motion if both have the points
/// in front. Throws PreconditionError if the spans differ in length, a coordinate is not finite, or `sigma`
/// is not above 0.
[[nodiscard]] TwoViewResult reconstruct_two_views(std::span<const Eigen::Vector2d> a,
                                                  std::span<const Eigen::Vector2d> b, double sigma,
                                                  const TwoViewOptions& options = {});

/// Holds the median ratio of measured to triangulated depth, its support and its spread.
struct MetricScale {
  std::size_t points = 0;      ///< points with a measured depth; the scale is determined from one on
  double metres_per_unit = 0;  ///< metres per unit of the two views' translation
  /// 1.4826 times the median absolute deviation of the ratios, over their median.
  double relative_mad = 0;
};

/// Computes the scale from measured depths. `depths_in_a` are metres along the optical axis for each of the
/// points, not above 0 if unknown. Throws PreconditionError if the spans differ in length.
[[nodiscard]] MetricScale metric_scale(std::span<const TwoViewPoint> points,
                                       std::span<const double> depths_in_a);

}  // namespace cairn
