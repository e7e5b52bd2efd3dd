// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cairn/report/svg.h"

namespace cairn {

/// A rectangle of a picture in which values are places.
struct Axes {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< pixels, upper left
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    ///< pixels
  Eigen::Vector2d low = Eigen::Vector2d::Zero();     ///< values at the lower left
  Eigen::Vector2d high = Eigen::Vector2d::Ones();    ///< values at the upper right

  /// Pixels of a value.
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& value) const;
};

struct AxesLabels {
  std::string across, up;                          ///< names of the values; none where empty
  bool numbers_across = true, numbers_up = true;   ///< false where a neighbour has them
  Eigen::Vector2d step = Eigen::Vector2d::Ones();  ///< between the lines of the grid, > 0
};

/// Grid, frame, numbers and names.
void draw_axes(const Axes& axes, const AxesLabels& labels, SvgCanvas& canvas);

/// 1, 2 or 5 times a power of ten: the smallest that puts at most `count` (> 0) steps into `range` (> 0).
[[nodiscard]] double nice_step(double range, double count);
/// Digits after the point that tell multiples of `step` apart.
[[nodiscard]] int decimals_of(double step);
/// The multiples of `step` in [low, high].
[[nodiscard]] std::vector<double> ticks(double low, double high, double step);

}  // namespace cairn
