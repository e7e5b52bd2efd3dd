// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cairn/report/axes.h"
#include "cairn/report/colors.h"
#include "cairn/report/trajectory_plot.h"

namespace cairn {

/// Paths in space seen along one axis of the world, and what explains them.
struct PathView {
  int across = 0, up = 1;  ///< axes of the world
  Axes axes;               ///< metres

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector3d& place) const {
    return axes({place[across], place[up]});
  }
};

void draw_reference(std::span<const Eigen::Vector3d> places, const PathView& view, SvgCanvas& canvas);
void draw_path(std::span<const TrajectoryPlot::Pose> poses, const std::string& color, const PathView& view,
               SvgCanvas& canvas);
/// Coloured by error_m, `largest_m` as the end of the scale; 0: all alike.
void draw_path_by_error(std::span<const TrajectoryPlot::Pose> poses, double largest_m, const PathView& view,
                        SvgCanvas& canvas);
/// Marks of the first and the last pose.
void draw_ends(std::span<const TrajectoryPlot::Pose> poses, const PathView& view, SvgCanvas& canvas);

struct LegendEntry {
  enum class Sample { reference, line, by_error, start, end };
  Sample sample = Sample::reference;
  std::string text;
  std::string color;  ///< of a line
};

/// Reference, each estimate (a single one as coloured by its error), start and end.
[[nodiscard]] std::vector<LegendEntry> legend_of(std::span<const TrajectoryPlot::Estimate> estimates);
/// Entries one after the other, `step` pixels apart, from the middle of the first sample's left edge on;
/// texts are shortened to `width` pixels.
void draw_legend(std::span<const LegendEntry> entries, const Eigen::Vector2d& first,
                 const Eigen::Vector2d& step, double width, SvgCanvas& canvas);
/// The scale of draw_path_by_error, at most `height` pixels.
void draw_color_bar(double largest_m, const Eigen::Vector2d& corner, double height, SvgCanvas& canvas);

}  // namespace cairn
