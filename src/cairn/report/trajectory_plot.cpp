// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_plot.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "cairn/report/error_chart.h"
#include "cairn/report/path_view.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeft = 84, kTop = 84, kRight = 40, kBottom = 60;  // pixels
constexpr double kRightOfBar = 116, kGap = 34, kChartGap = 74, kLegendRow = 22;

/// Where the views and what is below them lie, pixels.
struct Layout {
  Vector3d low, high;  ///< metres
  Vector3d extent;     ///< pixels of each axis of the world
  double step = 1;     ///< metres between lines of the grid

  [[nodiscard]] double width() const { return extent.x() + kGap + extent.y(); }
  [[nodiscard]] double height() const { return extent.y() + kGap + extent.z(); }
  /// The corner that the three views leave free.
  [[nodiscard]] Vector2d legend() const { return {kLeft + extent.x() + kGap, kTop + 0.5 * kLegendRow}; }
};

Eigen::AlignedBox3d box_of(const TrajectoryPlot& plot) {
  Eigen::AlignedBox3d box;
  for (const auto& place : plot.reference) box.extend(place);
  for (const auto& estimate : plot.estimates)
    for (const auto& pose : estimate.poses) box.extend(pose.place);
  if (box.isEmpty()) box.extend(Vector3d::Zero());
  return box;
}

/// One scale for all axes; a short axis is shown longer than it is, for the room that numbers and legend
/// need.
Layout make_layout(const TrajectoryPlot& plot) {
  constexpr double kMaxWidth = 760, kMaxHeight = 540, kMinExtent = 120, kMargin = 1.1;
  constexpr double kSmallest = 1e-3;  // metres, for a camera that stands still
  const Eigen::AlignedBox3d box = box_of(plot);
  const Vector3d shown = kMargin * box.sizes().cwiseMax(kSmallest);
  const double scale = std::min(kMaxWidth / (shown.x() + shown.y()), kMaxHeight / (shown.y() + shown.z()));
  const double legend = kLegendRow * static_cast<double>(plot.estimates.size() + 3);
  Layout layout;
  layout.extent =
      (scale * shown).cwiseMax(Vector3d(2 * kMinExtent, std::max(legend, 1.5 * kMinExtent), kMinExtent));
  const Vector3d half = 0.5 / scale * layout.extent;
  layout.low = box.center() - half;
  layout.high = box.center() + half;
  constexpr double kPixelsPerStep = 50;
  layout.step = nice_step(layout.extent.maxCoeff() / scale, layout.extent.maxCoeff() / kPixelsPerStep);
  return layout;
}

PathView make_view(const Layout& layout, int across, int up, const Vector2d& corner) {
  Axes axes{corner,
            {layout.extent[across], layout.extent[up]},
            {layout.low[across], layout.low[up]},
            {layout.high[across], layout.high[up]}};
  return {across, up, axes};
}

void draw_paths(const TrajectoryPlot& plot, double largest_m, const PathView& view, SvgCanvas& canvas) {
  draw_reference(plot.reference, view, canvas);
  const bool single = plot.estimates.size() == 1;
  for (std::size_t k = 0; k < plot.estimates.size(); ++k) {
    const auto& poses = plot.estimates[k].poses;
    single ? draw_path_by_error(poses, largest_m, view, canvas)
           : draw_path(poses, line_color(k), view, canvas);
  }
  for (const auto& estimate : plot.estimates) draw_ends(estimate.poses, view, canvas);
}

/// Views that share an axis lie side by side or one above the other, so that its numbers stand once.
void draw_views(const TrajectoryPlot& plot, const Layout& layout, double largest_m, SvgCanvas& canvas) {
  const double below = kTop + layout.extent.y() + kGap;
  const PathView xy = make_view(layout, 0, 1, {kLeft, kTop}), xz = make_view(layout, 0, 2, {kLeft, below}),
                 yz = make_view(layout, 1, 2, {kLeft + layout.extent.x() + kGap, below});
  const Vector2d step(layout.step, layout.step);
  draw_axes(xy.axes, {"", "y in metres", false, true, step}, canvas);
  draw_axes(xz.axes, {"x in metres", "z in metres", true, true, step}, canvas);
  draw_axes(yz.axes, {"y in metres", "", true, false, step}, canvas);
  for (const PathView* view : {&xy, &xz, &yz}) draw_paths(plot, largest_m, *view, canvas);
}

double largest_error_m(const TrajectoryPlot& plot) {
  double largest = 0;
  for (const auto& estimate : plot.estimates)
    for (const auto& pose : estimate.poses) largest = std::max(largest, pose.error_m);
  constexpr double kRounding = 1e-9;  // metres
  return largest < kRounding ? 0 : largest;
}

}  // namespace

std::string draw_trajectory_plot(const TrajectoryPlot& plot) {
  const Layout layout = make_layout(plot);
  const double largest_m = largest_error_m(plot);
  const double charts_top = kTop + layout.height() + kChartGap;
  const bool single = plot.estimates.size() == 1;
  SvgCanvas canvas(kLeft + layout.width() + (single ? kRightOfBar : kRight),
                   charts_top + error_charts_height() + kBottom);
  canvas.text({kLeft, 34}, plot.title, {.size = 17, .fill = kInk, .bold = true});
  canvas.text({kLeft, 57}, plot.subtitle, {.size = 13, .fill = kSoftInk});
  draw_views(plot, layout, largest_m, canvas);
  draw_legend(legend_of(plot.estimates), layout.legend(), {0, kLegendRow}, layout.extent.y(), canvas);
  if (single) draw_color_bar(largest_m, {kLeft + layout.width() + 24, kTop}, layout.height(), canvas);
  draw_error_charts(plot.estimates, {kLeft, charts_top}, layout.width(), canvas);
  return canvas.finish();
}

}  // namespace cairn
