// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/coverage_plot.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/report/axes.h"
#include "cairn/report/colors.h"
#include "cairn/report/svg.h"

namespace cairn {
namespace {

using Eigen::Vector2d;

constexpr double kSide = 350, kLeft = 84, kTop = 116, kGap = 120, kLegendTop = 66, kLegendRow = 21;  // pixels
constexpr std::size_t kPanelsInARow = 3;
constexpr const char* kBand = "#dfe6ee";

/// Draws where 95 % of the shares lie that `count` independent errors show: the normal approximation of the
/// binomial distribution.
void draw_band(std::size_t count, const Axes& axes, SvgCanvas& canvas) {
  constexpr double kSigmas = 1.96;
  constexpr int kSteps = 50;
  std::vector<Vector2d> rim;
  const auto bound = [&](int i, double sign) {
    const double share = static_cast<double>(i) / kSteps;
    const double deviation = std::sqrt(share * (1 - share) / static_cast<double>(count));
    const double at = std::clamp(share + sign * kSigmas * deviation, 0.0, 1.0);
    rim.push_back(axes({100 * share, 100 * at}));
  };
  for (int i = 0; i <= kSteps; ++i) bound(i, 1);
  for (int i = kSteps; i >= 0; --i) bound(i, -1);
  canvas.polyline(rim, {"none", kBand, 0});
}

void draw_curve(const ConsistencyReport& report, const Axes& axes, const std::string& color,
                SvgCanvas& canvas) {
  std::vector<Vector2d> points;
  const double steps = static_cast<double>(report.curve.size()) - 1;
  for (std::size_t i = 0; i < report.curve.size(); ++i)
    points.push_back(axes({100 * static_cast<double>(i) / steps, 100 * report.curve[i]}));
  canvas.polyline(points, {color, "none", 1.8});
  for (const Coverage& coverage : report.coverage)
    canvas.circle(axes({100 * coverage.nominal, 100 * coverage.actual}), 3.2, {"#ffffff", color, 1});
}

void draw_legend(const CoveragePlot::Panel& panel, const Vector2d& corner, SvgCanvas& canvas) {
  Vector2d place = corner;
  for (std::size_t i = 0; i < panel.curves.size(); ++i, place.y() += kLegendRow) {
    const auto& [name, report] = panel.curves[i];
    canvas.line(place, place + Vector2d(22, 0), {line_color(i), "none", 2.5});
    canvas.text(place + Vector2d(30, 4),
                fmt::format("{}: {}, NEES/dof {:.3g} (median {:.3g})", name, report.count,
                            report.mean_per_freedom(), report.median_ratio()),
                {.size = 12.5, .fill = kInk});
  }
}

void draw_panel(const CoveragePlot::Panel& panel, const Vector2d& corner, SvgCanvas& canvas) {
  require(!panel.curves.empty(), "a panel has a curve");
  const Axes axes{corner, {kSide, kSide}, {0, 0}, {100, 100}};
  canvas.text(corner - Vector2d(0, 12), panel.title, {.size = 14, .fill = kInk, .bold = true});
  draw_band(panel.curves.front().report.count, axes, canvas);
  draw_axes(axes, {"expected share, %", "observed share, %", true, true, {20, 20}}, canvas);
  canvas.line(axes({0, 0}), axes({100, 100}), {kReference, "none", 1.4});
  for (std::size_t i = 0; i < panel.curves.size(); ++i)
    draw_curve(panel.curves[i].report, axes, line_color(i), canvas);
  draw_legend(panel, corner + Vector2d(0, kSide + kLegendTop), canvas);
}

}  // namespace

std::string draw_coverage_plot(const CoveragePlot& plot) {
  require(!plot.panels.empty(), "there is a panel");
  std::size_t most_curves = 0;
  for (const auto& panel : plot.panels) most_curves = std::max(most_curves, panel.curves.size());
  const double height = kSide + kLegendTop + kLegendRow * static_cast<double>(most_curves) + 44;
  const std::size_t columns = std::min(kPanelsInARow, plot.panels.size());
  const std::size_t rows = (plot.panels.size() + kPanelsInARow - 1) / kPanelsInARow;
  constexpr double kNarrowest = 740;  // for the titles
  SvgCanvas canvas(std::max(kNarrowest, kLeft + static_cast<double>(columns) * (kSide + kGap)),
                   kTop + static_cast<double>(rows) * height);
  canvas.text({kLeft, 34}, plot.title, {.size = 17, .fill = kInk, .bold = true});
  canvas.text({kLeft, 57}, plot.subtitle, {.size = 13, .fill = kSoftInk});
  canvas.text({kLeft, 77},
              "below the diagonal: promises too much; band: 95 % of independent errors, if honest",
              {.size = 13, .fill = kSoftInk});
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const std::size_t row = i / kPanelsInARow, column = i % kPanelsInARow;
    draw_panel(
        plot.panels[i],
        {kLeft + static_cast<double>(column) * (kSide + kGap), kTop + static_cast<double>(row) * height},
        canvas);
  }
  return canvas.finish();
}

}  // namespace cairn
