// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/trajectory_plot.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/report/svg.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMaxPlotWidth = 760, kMaxPlotHeight = 620;  // pixels, as are the margins
constexpr double kMinPlotSide = 220;
constexpr double kLeft = 76, kTop = 96, kRight = 120, kBottom = 64;
const std::string kInk = "#1e293b", kSoftInk = "#64748b", kGrid = "#e9edf2", kReference = "#b6c0cd";

/// The plasma colour map (van der Walt and Smith 2015) up to 85 %: its yellow end is lost on white.
std::string color_of(double share) {
  constexpr std::array<std::array<double, 3>, 6> kStops = {
      {{13, 8, 135}, {91, 1, 165}, {154, 23, 155}, {203, 70, 121}, {235, 120, 82}, {251, 178, 47}}};
  const double position = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const double part = position - static_cast<double>(stop);
  const auto channel = [&](std::size_t c) {
    return static_cast<int>(std::lround((1 - part) * kStops[stop][c] + part * kStops[stop + 1][c]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2));
}

/// 1, 2 or 5 times a power of ten: the smallest that puts at most `count` steps into `range`.
double nice_step(double range, int count) {
  const double raw = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

int decimals_of(double step) {
  return std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
}

/// From metres along two axes of the world to pixels.
struct View {
  int across = 0, up = 1;  ///< axes of the world
  Vector2d low, high;      ///< metres at the plot's edges
  double scale = 1;        ///< pixels per metre

  [[nodiscard]] Vector2d size() const { return scale * (high - low); }
  [[nodiscard]] Vector2d operator()(const Vector2d& place) const {
    return {kLeft + scale * (place.x() - low.x()), kTop + scale * (high.y() - place.y())};
  }
  [[nodiscard]] Vector2d operator()(const Vector3d& place) const {
    return (*this)(Vector2d(place[across], place[up]));
  }
};

View choose_view(const TrajectoryPlot& plot) {
  Eigen::AlignedBox3d box;
  for (const auto& place : plot.reference) box.extend(place);
  for (const auto& pose : plot.estimate) box.extend(pose.place);
  if (box.isEmpty()) box.extend(Vector3d::Zero());
  const Vector3d spread = box.sizes();
  int least = 2;  // of equals the last, so that x and y are shown
  for (const int axis : {1, 0}) {
    if (spread[axis] < spread[least]) least = axis;
  }
  View view;
  view.across = least == 0 ? 1 : 0;
  view.up = least == 2 ? 1 : 2;
  const Vector2d centre(box.center()[view.across], box.center()[view.up]);
  constexpr double kSmallest = 1e-3;  // metres, for a camera that stands still
  const Vector2d shown = 1.1 * Vector2d(spread[view.across], spread[view.up]).cwiseMax(kSmallest);
  view.scale = std::min(kMaxPlotWidth / shown.x(), kMaxPlotHeight / shown.y());
  const Vector2d half = 0.5 * shown.cwiseMax(kMinPlotSide / view.scale);
  view.low = centre - half;
  view.high = centre + half;
  return view;
}

/// Multiples of `step` in [low, high].
std::vector<double> ticks(double low, double high, double step) {
  std::vector<double> result;
  for (double k = std::ceil(low / step); k * step <= high; ++k) result.push_back(k * step + 0.0);  // no -0
  return result;
}

void draw_grid(const View& view, SvgCanvas& canvas) {
  const Vector2d size = view.size();
  const double step = nice_step((view.high - view.low).maxCoeff(), 8);
  const int decimals = decimals_of(step);
  const SvgStyle grid{kGrid, "none", 1};
  const double bottom = kTop + size.y();
  for (const double x : ticks(view.low.x(), view.high.x(), step)) {
    const double at = view(Vector2d(x, view.low.y())).x();
    canvas.line({at, kTop}, {at, bottom}, grid);
    canvas.text({at, bottom + 20}, fmt::format("{:.{}f}", x, decimals),
                {.size = 12, .fill = kSoftInk, .anchor = SvgAnchor::middle});
  }
  for (const double y : ticks(view.low.y(), view.high.y(), step)) {
    const double at = view(Vector2d(view.low.x(), y)).y();
    canvas.line({kLeft, at}, {kLeft + size.x(), at}, grid);
    canvas.text({kLeft - 10, at + 4}, fmt::format("{:.{}f}", y, decimals),
                {.size = 12, .fill = kSoftInk, .anchor = SvgAnchor::end});
  }
  canvas.rectangle({kLeft, kTop}, size, {"#cbd5e1", "none", 1});
  constexpr std::string_view kAxes = "xyz";
  canvas.text({kLeft + 0.5 * size.x(), bottom + 46},
              fmt::format("{} in metres", kAxes[static_cast<std::size_t>(view.across)]),
              {.fill = kInk, .anchor = SvgAnchor::middle});
  canvas.text({kLeft - 54, kTop + 0.5 * size.y()},
              fmt::format("{} in metres", kAxes[static_cast<std::size_t>(view.up)]),
              {.fill = kInk, .anchor = SvgAnchor::middle, .turned_deg = 90});
}

void draw_reference(const TrajectoryPlot& plot, const View& view, SvgCanvas& canvas) {
  std::vector<Vector2d> points;
  for (const auto& place : plot.reference) {
    const Vector2d point = view(place);
    constexpr double kMinStep = 0.3;  // pixels; motion capture at 100 Hz would only make the file large
    if (points.empty() || (point - points.back()).norm() >= kMinStep) points.push_back(point);
  }
  canvas.polyline(points, {kReference, "none", 4.5});
}

/// One polyline for each run of poses whose errors look the same.
void draw_estimate(const TrajectoryPlot& plot, const View& view, double largest, SvgCanvas& canvas) {
  constexpr double kShades = 32;
  const auto shade_of = [&](std::size_t i) {
    return largest > 0 ? std::round(kShades * plot.estimate[i].error_m / largest) / kShades : 0.0;
  };
  std::vector<Vector2d> run;
  double shade = 0;
  const auto flush = [&] {
    if (run.size() > 1) canvas.polyline(run, {color_of(shade), "none", 2});
    run.clear();
  };
  for (std::size_t i = 0; i < plot.estimate.size(); ++i) {
    const Vector2d here = view(plot.estimate[i].place);
    const double shade_here = shade_of(i);
    if (i == 0 || !plot.estimate[i].connected) {
      flush();
    } else if (run.empty() || shade_here != shade) {
      flush();
      run.push_back(view(plot.estimate[i - 1].place));
    }
    shade = shade_here;
    run.push_back(here);
  }
  flush();
}

void draw_ends(const TrajectoryPlot& plot, const View& view, SvgCanvas& canvas) {
  if (plot.estimate.empty()) return;
  canvas.circle(view(plot.estimate.front().place), 5, {kInk, "#ffffff", 2});
  canvas.circle(view(plot.estimate.back().place), 5, {"#ffffff", kInk, 1.5});
}

void draw_color_bar(const View& view, double largest, SvgCanvas& canvas) {
  constexpr int kSteps = 48;
  constexpr double kWidth = 14;
  const double left = kLeft + view.size().x() + 26;
  const double height = std::min(260.0, view.size().y() - 24), bottom = kTop + 24 + height;
  const bool centimetres = largest < 1.0;
  canvas.text({left, kTop + 10}, centimetres ? "error, cm" : "error, m", {.size = 12, .fill = kInk});
  for (int i = 0; i < kSteps; ++i) {
    canvas.rectangle({left, bottom - height * (i + 1) / kSteps}, {kWidth, height / kSteps + 0.5},
                     {"none", color_of((i + 0.5) / kSteps), 0});
  }
  if (largest <= 0) return canvas.text({left + kWidth + 8, bottom + 4}, "0", {.size = 12, .fill = kSoftInk});
  const double top_value = centimetres ? 100 * largest : largest;
  const double step = nice_step(top_value, 5);
  for (const double value : ticks(0, top_value * (1 + 1e-9), step)) {
    const double at = bottom - height * value / top_value;
    canvas.line({left + kWidth, at}, {left + kWidth + 4, at}, {kSoftInk, "none", 1});
    canvas.text({left + kWidth + 9, at + 4}, fmt::format("{:.{}f}", value, decimals_of(step)),
                {.size = 12, .fill = kSoftInk});
  }
}

void draw_legend(const TrajectoryPlot& plot, SvgCanvas& canvas) {
  canvas.text({kLeft, 30}, plot.title, {.size = 17, .fill = kInk, .bold = true});
  canvas.text({kLeft, 51}, plot.subtitle, {.size = 13, .fill = kSoftInk});
  constexpr double kRow = 76;
  double x = kLeft;
  canvas.line({x, kRow - 4}, {x + 26, kRow - 4}, {kReference, "none", 4.5});
  canvas.text({x + 34, kRow}, "reference", {.fill = kInk});
  x += 116;
  for (int i = 0; i < 13; ++i)
    canvas.line({x + 2 * i, kRow - 4}, {x + 2 * i + 2, kRow - 4}, {color_of(i / 12.0), "none", 2.5});
  canvas.text({x + 34, kRow}, "estimate", {.fill = kInk});
  x += 112;
  canvas.circle({x + 4, kRow - 4}, 5, {kInk, "#ffffff", 2});
  canvas.text({x + 16, kRow}, "start", {.fill = kInk});
  canvas.circle({x + 68, kRow - 4}, 5, {"#ffffff", kInk, 1.5});
  canvas.text({x + 80, kRow}, "end", {.fill = kInk});
}

}  // namespace

std::string draw_trajectory_plot(const TrajectoryPlot& plot) {
  const View view = choose_view(plot);
  double largest = 0;
  for (const auto& pose : plot.estimate) largest = std::max(largest, pose.error_m);
  constexpr double kRounding = 1e-9;  // metres
  if (largest < kRounding) largest = 0;
  constexpr double kMinWidth = 560;  // room for the title
  const Vector2d size = view.size();
  SvgCanvas canvas(std::max(kMinWidth, kLeft + size.x() + kRight), kTop + size.y() + kBottom);
  draw_legend(plot, canvas);
  draw_grid(view, canvas);
  draw_reference(plot, view, canvas);
  draw_estimate(plot, view, largest, canvas);
  draw_ends(plot, view, canvas);
  draw_color_bar(view, largest, canvas);
  return canvas.finish();
}

}  // namespace cairn
