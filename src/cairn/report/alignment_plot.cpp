// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/alignment_plot.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "cairn/report/path_view.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

constexpr double kLeft = 84, kTop = 132, kBottom = 60, kGap = 90, kRight = 30;  // pixels
constexpr double kSide = 400;                                                   // of each half

/// The axis along which to look.
int least_spread(const Places& places) {
  Eigen::AlignedBox3d box;
  for (const auto& place : places) box.extend(place);
  if (box.isEmpty()) return 2;
  int least = 2;  // of equals the last, so that x and y are shown
  for (const int axis : {1, 0}) {
    if (box.sizes()[axis] < box.sizes()[least]) least = axis;
  }
  return least;
}

/// A square around both paths.
PathView make_view(const Places& reference, const Places& estimate, int along, double left) {
  PathView view{along == 0 ? 1 : 0, along == 2 ? 1 : 2, {}};
  Eigen::AlignedBox2d box;
  for (const Places* places : {&reference, &estimate})
    for (const auto& place : *places) box.extend(Vector2d(place[view.across], place[view.up]));
  if (box.isEmpty()) box.extend(Vector2d(0, 0));
  constexpr double kSmallest = 1e-3, kMargin = 1.1;  // metres, for paths of one place
  const double half = 0.5 * kMargin * std::max(kSmallest, box.sizes().maxCoeff());
  view.axes = {{left, kTop}, {kSide, kSide}, box.center().array() - half, box.center().array() + half};
  return view;
}

std::vector<TrajectoryPlot::Pose> as_poses(const Places& places) {
  std::vector<TrajectoryPlot::Pose> poses;
  for (const auto& place : places) poses.push_back({.place = place});
  return poses;
}

void draw_half(const std::string& name, const Places& reference, const Places& estimate, const PathView& view,
               SvgCanvas& canvas) {
  constexpr std::string_view kAxes = "xyz";
  constexpr double kSteps = 6;
  const double step = nice_step(view.axes.high.x() - view.axes.low.x(), kSteps);
  const auto label = [&](int axis) {
    return fmt::format("{} in metres", kAxes[static_cast<std::size_t>(axis)]);
  };
  canvas.text(view.axes.corner - Vector2d(0, 12), name, {.size = 14, .fill = kInk, .bold = true});
  draw_axes(view.axes, {label(view.across), label(view.up), true, true, {step, step}}, canvas);
  const std::vector<TrajectoryPlot::Pose> poses = as_poses(estimate);
  draw_reference(reference, view, canvas);
  draw_path(poses, line_color(0), view, canvas);
  draw_ends(poses, view, canvas);
}

}  // namespace

std::string draw_alignment_plot(const AlignmentPlot& plot) {
  SvgCanvas canvas(kLeft + 2 * kSide + kGap + kRight, kTop + kSide + kBottom);
  canvas.text({kLeft, 34}, plot.title, {.size = 17, .fill = kInk, .bold = true});
  canvas.text({kLeft, 57}, plot.subtitle, {.size = 13, .fill = kSoftInk});
  const LegendEntry entries[] = {{LegendEntry::Sample::reference, "reference", {}},
                                 {LegendEntry::Sample::line, "estimate", line_color(0)},
                                 {LegendEntry::Sample::start, "start", {}},
                                 {LegendEntry::Sample::end, "end", {}}};
  constexpr double kEntry = 130;
  draw_legend(entries, {kLeft, 84}, {kEntry, 0}, kEntry, canvas);
  const int along = least_spread(plot.reference);
  draw_half(plot.before, plot.reference, plot.estimate_before,
            make_view(plot.reference, plot.estimate_before, along, kLeft), canvas);
  draw_half(plot.after, plot.reference, plot.estimate_after,
            make_view(plot.reference, plot.estimate_after, along, kLeft + kSide + kGap), canvas);
  return canvas.finish();
}

}  // namespace cairn
