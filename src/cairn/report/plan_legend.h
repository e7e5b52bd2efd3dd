// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>

#include "cairn/image/image.h"
#include "cairn/report/plan_view.h"

namespace cairn {

/// Formats a length of 1, 2 or 5 times a power of ten metres: "50 m", "20 cm", "2 km".
[[nodiscard]] std::string format_length(double metres);

/// Draws a bar of a round length in metres; `right` is the right end of its baseline, pixels.
void draw_scale_bar(RgbImage& picture, double pixels_per_metre, const Eigen::Vector2d& right);

/// Draws the scale of std_rgb with its ends in metres from `corner` on, 300 pixels wide; with a sample of
/// unknown ones if there are any, or nothing but that if all are unknown.
struct StdLegend {
  bool has_known = true, has_unknown = false;
};
void draw_std_legend(RgbImage& picture, const StdLegend& legend, const Eigen::Vector2d& corner);

/// Draws a dot and what it means, one entry after the other from `place` (left end of the baseline) on;
/// returns the column after the last.
double draw_dot_legend(RgbImage& picture, std::span<const std::pair<Rgb8, std::string>> entries,
                       const Eigen::Vector2d& place);

/// Draws arrows along the two axes of the plane with their names, or one for north; `corner` is the upper
/// right one, pixels.
void draw_directions(RgbImage& picture, const PlanAxes& axes, const Eigen::Vector2d& corner);

}  // namespace cairn
