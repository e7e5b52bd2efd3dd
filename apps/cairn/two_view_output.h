// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/dense/cloud.h"
#include "cairn/geometry/two_view.h"
#include "feature_arguments.h"

namespace cairn::app {

/// What `cairn two-view` worked out of two images.
struct TwoViewReport {
  const TimedFeatures& a;
  const TimedFeatures& b;
  std::vector<Eigen::Vector2d> pixels_in_a, pixels_in_b;  ///< of the matches
  double sigma_px = 0, focal_px = 0;
  TwoViewResult result;
  std::optional<MetricScale> scale;  ///< where a depth image was given

  /// Metres of a unit of the result, 1 where they are not known.
  [[nodiscard]] double unit() const { return scale && scale->points > 0 ? scale->metres_per_unit : 1.0; }
};

void print_two_view(const TwoViewReport& report);
void print_two_view_json(const TwoViewReport& report);
/// One row a point: pixels in both images, coordinates in A's camera, angle between the rays.
[[nodiscard]] std::string format_points(const TwoViewReport& report);
/// The same points, grey as they are in A.
[[nodiscard]] Cloud cloud_of(const TwoViewReport& report);

/// Singular values, factors, the four motions and their products with the translation.
void print_decomposition(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts);
void print_decomposition_json(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts);
/// How far the matrix is from an essential one: norm of the difference over the norm.
[[nodiscard]] double relative_distance(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts);

}  // namespace cairn::app
