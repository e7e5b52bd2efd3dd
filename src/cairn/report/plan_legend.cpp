// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/plan_legend.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cairn/report/axes.h"
#include "cairn/report/colors.h"
#include "cairn/report/lettering.h"
#include "cairn/report/raster.h"

namespace cairn {
namespace {

constexpr Rgb8 kPen{30, 41, 59};

void draw_arrow(RgbImage& picture, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr double kWidth = 1.8, kHead = 8;
  const Eigen::Vector2d along = kHead * (to - from).normalized(), aside(-along.y(), along.x());
  draw_line(picture, from, to, kPen, kWidth);
  draw_line(picture, to, to - along + 0.5 * aside, kPen, kWidth);
  draw_line(picture, to, to - along - 0.5 * aside, kPen, kWidth);
}

}  // namespace

std::string format_length(double metres) {
  if (metres >= 1000) return fmt::format("{:.0f} km", metres / 1000);
  if (metres >= 1) return fmt::format("{:.0f} m", metres);
  if (metres >= 0.01) return fmt::format("{:.0f} cm", 100 * metres);
  return fmt::format("{:g} mm", 1000 * metres);
}

void draw_scale_bar(RgbImage& picture, double pixels_per_metre, const Eigen::Vector2d& right) {
  constexpr double kLongest = 360, kTick = 6, kWidth = 2.5;               // pixels
  const double length = nice_step(kLongest / 2.5 / pixels_per_metre, 1);  // 144 to 360 pixels
  const Eigen::Vector2d left = right - Eigen::Vector2d(length * pixels_per_metre, 0), tick(0, -kTick);
  draw_line(picture, left, right, kPen, kWidth);
  draw_line(picture, left, left + tick, kPen, kWidth);
  draw_line(picture, right, right + tick, kPen, kWidth);
  draw_text(picture, 0.5 * (left + right) - Eigen::Vector2d(0, 10), format_length(length),
            {.anchor = LetteringAnchor::middle});
}

void draw_std_legend(RgbImage& picture, const StdLegend& legend, const Eigen::Vector2d& corner) {
  constexpr double kWidth = 300, kHeight = 12;
  const Eigen::Vector2d below(0, kHeight + 17);
  draw_text(picture, corner - Eigen::Vector2d(0, 9),
            legend.has_known ? "standard deviation of a landmark" : "standard deviation not computed");
  if (!legend.has_known) return;
  for (int u = 0; u < static_cast<int>(kWidth); ++u)
    fill_rectangle(picture, corner + Eigen::Vector2d(u, 0), {1, kHeight}, error_rgb(u / (kWidth - 1)));
  const std::array<std::pair<double, const char*>, 5> marks{
      {{0.0, "<1 cm"}, {0.25, "3"}, {0.5, "10"}, {0.75, "30"}, {1.0, ">1 m"}}};
  for (const auto& [share, text] : marks)
    draw_text(picture, corner + below + Eigen::Vector2d(share * kWidth, 0), text,
              {.height_px = 11, .anchor = LetteringAnchor::middle});
  if (legend.has_unknown)
    draw_dot_legend(picture, std::array{std::pair(kUnknownStd, std::string("unknown"))},
                    corner + Eigen::Vector2d(kWidth + 40, kHeight));
}

double draw_dot_legend(RgbImage& picture, std::span<const std::pair<Rgb8, std::string>> entries,
                       const Eigen::Vector2d& place) {
  constexpr double kRadius = 6, kGap = 14, kNext = 34, kHeight = 13;
  Eigen::Vector2d pen = place;
  for (const auto& [color, text] : entries) {
    fill_circle(picture, pen + Eigen::Vector2d(kRadius, -0.5 * kHeight), kRadius, color);
    draw_text(picture, pen + Eigen::Vector2d(kRadius + kGap, 0), text, {.height_px = kHeight});
    pen.x() += kRadius + kGap + text_width(text, kHeight) + kNext;
  }
  return pen.x();
}

void draw_directions(RgbImage& picture, const PlanAxes& axes, const Eigen::Vector2d& corner) {
  constexpr double kLength = 42;
  if (axes.right_name.empty()) return;
  const Eigen::Vector2d foot = corner + Eigen::Vector2d(-kLength - 24, kLength + 22);
  draw_arrow(picture, foot, foot - Eigen::Vector2d(0, kLength));
  draw_text(picture, foot + Eigen::Vector2d(0, -kLength - 8), axes.up_name,
            {.anchor = LetteringAnchor::middle, .bold = true});
  draw_arrow(picture, foot, foot + Eigen::Vector2d(kLength, 0));
  draw_text(picture, foot + Eigen::Vector2d(kLength + 7, 6), axes.right_name, {.bold = true});
}

}  // namespace cairn
