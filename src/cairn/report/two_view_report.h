// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cairn/dense/cloud.h"
#include "cairn/geometry/essential.h"
#include "cairn/geometry/two_view.h"
#include "cairn/report/features_report.h"

namespace cairn {

/// Holds what was worked out of two images.
struct TwoViewReport {
  const TimedFeatures& a;
  const TimedFeatures& b;
  std::vector<Eigen::Vector2d> pixels_in_a, pixels_in_b;  ///< of the matches
  double sigma_px = 0, focal_px = 0;
  TwoViewResult result;
  std::optional<MetricScale> scale;  ///< if a depth image was given

  /// Returns the metres in a unit of the result, 1 if they are not known.
  [[nodiscard]] double unit() const { return scale && scale->points > 0 ? scale->metres_per_unit : 1.0; }
};

/// Returns counts, matrices, the motions that are possible and the one chosen, for people.
[[nodiscard]] std::string format_two_view_text(const TwoViewReport& report);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_two_view_json(const TwoViewReport& report);
/// Returns a line of names, then one row for each point: pixels in both images, coordinates in A's camera
/// (metres if the scale is known), angle between the rays (degrees).
[[nodiscard]] std::string format_points_csv(const TwoViewReport& report);
/// Returns the same points as a cloud, grey as they are in A.
[[nodiscard]] Cloud cloud_of(const TwoViewReport& report);

/// Returns the matrix, its singular values, factors, the four motions and their products with the
/// translation.
[[nodiscard]] std::string format_decomposition_text(const Eigen::Matrix3d& essential,
                                                    const EssentialDecomposition& parts);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_decomposition_json(const Eigen::Matrix3d& essential,
                                                    const EssentialDecomposition& parts);
/// Returns how far the matrix is from an essential one: norm of the difference over the norm.
[[nodiscard]] double relative_distance(const Eigen::Matrix3d& essential, const EssentialDecomposition& parts);

}  // namespace cairn
