// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cairn/image/image.h"

namespace cairn {

/// A match of an image with a map, in pixels.
struct DrawnMatch {
  Eigen::Vector2d seen;       ///< the feature
  Eigen::Vector2d projected;  ///< the landmark, as the pose has it
  bool inlier = false;
};

/// The image with a circle around each feature (green: inlier, red: outlier) and a line to where the pose
/// has its landmark, which a dot marks.
[[nodiscard]] RgbImage draw_localization(const GrayImage& image, const std::vector<DrawnMatch>& matches);

}  // namespace cairn
