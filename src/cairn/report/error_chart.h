// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cairn/report/svg.h"
#include "cairn/report/trajectory_plot.h"

namespace cairn {

/// Two charts one below the other: translation and rotation error of each estimate over time. `corner` is the
/// upper left of the first one's axes, `width` their width, pixels; numbers and names stand left and below.
void draw_error_charts(std::span<const TrajectoryPlot::Estimate> estimates, const Eigen::Vector2d& corner,
                       double width, SvgCanvas& canvas);
/// From the top of the first axes to the bottom of the second, pixels.
[[nodiscard]] double error_charts_height();

}  // namespace cairn
