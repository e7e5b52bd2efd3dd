// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/path_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/report/colors.h"

namespace cairn {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReferenceWidth = 4.5, kPathWidth = 2, kSample = 28;  // pixels

/// Calls draw(first, last) for each run of poses that are connected and of one `shade_of(i)`; a run begins
/// with the pose before it, so that runs touch.
template <class ShadeOf, class Draw>
void for_each_run(std::span<const TrajectoryPlot::Pose> poses, const ShadeOf& shade_of, const Draw& draw) {
  std::size_t first = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const bool ends = i + 1 == poses.size() || !poses[i + 1].connected || shade_of(i + 1) != shade_of(i);
    if (!poses[i].connected) {
      first = i;
    } else if (ends) {
      draw(first, i);
      first = i;
    }
  }
}

std::vector<Vector2d> project(std::span<const TrajectoryPlot::Pose> poses, const PathView& view) {
  std::vector<Vector2d> points;
  for (const auto& pose : poses) points.push_back(view(pose.place));
  return points;
}

/// As many letters of a name's end as a width holds, roughly.
std::string shortened(const std::string& name, double width) {
  constexpr double kLetter = 6.8;  // pixels
  const auto letters = static_cast<std::size_t>(std::max(4.0, width / kLetter));
  return name.size() <= letters ? name : "…" + name.substr(name.size() - letters + 1);
}

void draw_start(const Vector2d& at, SvgCanvas& canvas) {
  canvas.circle(at, 5, {kInk, "#ffffff", 2});
}
void draw_end(const Vector2d& at, SvgCanvas& canvas) {
  canvas.circle(at, 5, {"#ffffff", kInk, 1.5});
}

void draw_sample(const LegendEntry& entry, const Vector2d& left, SvgCanvas& canvas) {
  const Vector2d right = left + Vector2d(kSample, 0), middle = 0.5 * (left + right);
  switch (entry.sample) {
    case LegendEntry::Sample::reference:
      return canvas.line(left, right, {kReference, "none", kReferenceWidth});
    case LegendEntry::Sample::line:
      return canvas.line(left, right, {entry.color, "none", kPathWidth + 0.5});
    case LegendEntry::Sample::start:
      return draw_start(middle, canvas);
    case LegendEntry::Sample::end:
      return draw_end(middle, canvas);
    case LegendEntry::Sample::by_error:
      break;
  }
  constexpr int kPieces = 14;
  for (int i = 0; i < kPieces; ++i) {
    canvas.line(left + (right - left) * i / kPieces, left + (right - left) * (i + 1) / kPieces,
                {error_color(i / (kPieces - 1.0)), "none", kPathWidth + 0.5});
  }
}

}  // namespace

void draw_reference(std::span<const Vector3d> places, const PathView& view, SvgCanvas& canvas) {
  std::vector<Vector2d> points;
  for (const auto& place : places) {
    const Vector2d point = view(place);
    constexpr double kMinStep = 0.3;  // pixels; motion capture at 100 Hz would only make the file large
    if (points.empty() || (point - points.back()).norm() >= kMinStep) points.push_back(point);
  }
  canvas.polyline(points, {kReference, "none", kReferenceWidth});
}

void draw_path(std::span<const TrajectoryPlot::Pose> poses, const std::string& color, const PathView& view,
               SvgCanvas& canvas) {
  for_each_run(
      poses, [](std::size_t) { return 0; },
      [&](std::size_t first, std::size_t last) {
        canvas.polyline(project(poses.subspan(first, last - first + 1), view), {color, "none", kPathWidth});
      });
}

void draw_path_by_error(std::span<const TrajectoryPlot::Pose> poses, double largest_m, const PathView& view,
                        SvgCanvas& canvas) {
  constexpr double kShades = 32;
  const auto shade_of = [&](std::size_t i) {
    return largest_m > 0 ? std::round(kShades * poses[i].error_m / largest_m) / kShades : 0.0;
  };
  for_each_run(poses, shade_of, [&](std::size_t first, std::size_t last) {
    canvas.polyline(project(poses.subspan(first, last - first + 1), view),
                    {error_color(shade_of(last)), "none", kPathWidth});
  });
}

void draw_ends(std::span<const TrajectoryPlot::Pose> poses, const PathView& view, SvgCanvas& canvas) {
  if (poses.empty()) return;
  draw_start(view(poses.front().place), canvas);
  draw_end(view(poses.back().place), canvas);
}

std::vector<LegendEntry> legend_of(std::span<const TrajectoryPlot::Estimate> estimates) {
  using Sample = LegendEntry::Sample;
  std::vector<LegendEntry> entries = {{Sample::reference, "reference", kReference}};
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    entries.push_back(
        {estimates.size() == 1 ? Sample::by_error : Sample::line, estimates[k].name, line_color(k)});
  }
  entries.push_back({Sample::start, "start", {}});
  entries.push_back({Sample::end, "end", {}});
  return entries;
}

void draw_legend(std::span<const LegendEntry> entries, const Vector2d& first, const Vector2d& step,
                 double width, SvgCanvas& canvas) {
  constexpr double kText = kSample + 10;
  Vector2d at = first;
  for (const auto& entry : entries) {
    draw_sample(entry, at, canvas);
    canvas.text(at + Vector2d(kText, 4), shortened(entry.text, width - kText), {.fill = kInk});
    at += step;
  }
}

void draw_color_bar(double largest_m, const Vector2d& corner, double height, SvgCanvas& canvas) {
  constexpr int kSteps = 48;
  constexpr double kWidth = 14, kTitle = 24, kMaxHeight = 260;
  const bool centimetres = largest_m < 1.0;
  const double shown = std::min(kMaxHeight, height - kTitle), bottom = corner.y() + kTitle + shown;
  canvas.text(corner + Vector2d(0, 10), centimetres ? "error, cm" : "error, m", {.size = 12, .fill = kInk});
  for (int i = 0; i < kSteps; ++i) {
    canvas.rectangle({corner.x(), bottom - shown * (i + 1) / kSteps}, {kWidth, shown / kSteps + 0.5},
                     {"none", error_color((i + 0.5) / kSteps), 0});
  }
  const SvgText number{.size = 12, .fill = kSoftInk};
  const double right = corner.x() + kWidth;
  if (largest_m <= 0) return canvas.text({right + 8, bottom + 4}, "0", number);
  const double top_value = centimetres ? 100 * largest_m : largest_m;
  const double step = nice_step(top_value, 5);
  for (const double value : ticks(0, top_value, step)) {
    const double at = bottom - shown * value / top_value;
    canvas.line({right, at}, {right + 4, at}, {kSoftInk, "none", 1});
    canvas.text({right + 9, at + 4}, fmt::format("{:.{}f}", value, decimals_of(step)), number);
  }
}

}  // namespace cairn
