// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/error_chart.h"

#include <algorithm>

#include "cairn/report/axes.h"
#include "cairn/report/colors.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Estimates = std::span<const TrajectoryPlot::Estimate>;
using Pose = TrajectoryPlot::Pose;

constexpr double kHeight = 120, kGap = 22;  // pixels

struct Range {
  double low = 0, high = 0;
};

Range times_of(Estimates estimates) {
  bool any = false;
  Range range;
  for (const auto& estimate : estimates) {
    for (const auto& pose : estimate.poses) {
      range.low = any ? std::min(range.low, pose.time_s) : pose.time_s;
      range.high = any ? std::max(range.high, pose.time_s) : pose.time_s;
      any = true;
    }
  }
  if (range.high <= range.low) range.high = range.low + 1;
  return range;
}

double largest_of(Estimates estimates, double Pose::*error) {
  double largest = 0;
  for (const auto& estimate : estimates)
    for (const auto& pose : estimate.poses) largest = std::max(largest, pose.*error);
  return largest;
}

/// What a chart shows: an error times `factor`, named.
struct Quantity {
  double Pose::*error;
  double factor;
  std::string name;
};

void draw_line(const std::vector<Pose>& poses, const Quantity& quantity, const Axes& axes,
               const std::string& color, SvgCanvas& canvas) {
  std::vector<Vector2d> run;
  const auto flush = [&] {
    if (run.size() > 1) canvas.polyline(run, {color, "none", 1.4});
    run.clear();
  };
  for (const auto& pose : poses) {
    if (!pose.connected) flush();
    run.push_back(axes({pose.time_s, quantity.factor * pose.*(quantity.error)}));
  }
  flush();
}

void draw_chart(Estimates estimates, const Quantity& quantity, Axes axes, bool lowest, SvgCanvas& canvas) {
  constexpr double kPixelsPerStep = 90, kSteps = 4, kRounding = 1e-9, kMargin = 1.05;
  const double largest = quantity.factor * largest_of(estimates, quantity.error);
  axes.high.y() = largest > kRounding ? kMargin * largest : 1;
  const Vector2d step(nice_step(axes.high.x() - axes.low.x(), axes.size.x() / kPixelsPerStep),
                      nice_step(axes.high.y(), kSteps));
  draw_axes(axes, {lowest ? "time in seconds" : "", quantity.name, lowest, true, step}, canvas);
  for (std::size_t k = 0; k < estimates.size(); ++k)
    draw_line(estimates[k].poses, quantity, axes, line_color(k), canvas);
}

}  // namespace

double error_charts_height() {
  return 2 * kHeight + kGap;
}

void draw_error_charts(Estimates estimates, const Vector2d& corner, double width, SvgCanvas& canvas) {
  const Range times = times_of(estimates);
  const bool centimetres = largest_of(estimates, &Pose::error_m) < 1.0;
  const Quantity translation{&Pose::error_m, centimetres ? 100.0 : 1.0,
                             centimetres ? "error in cm" : "error in m"};
  const Quantity rotation{&Pose::error_deg, 1, "error in deg"};
  Axes axes{corner, {width, kHeight}, {times.low, 0}, {times.high, 1}};
  draw_chart(estimates, translation, axes, false, canvas);
  axes.corner.y() += kHeight + kGap;
  draw_chart(estimates, rotation, axes, true, canvas);
}

}  // namespace cairn
