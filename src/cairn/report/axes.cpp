// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/report/colors.h"

namespace cairn {

using Eigen::Vector2d;

Vector2d Axes::operator()(const Vector2d& value) const {
  const Vector2d share = (value - low).cwiseQuotient(high - low);
  return {corner.x() + share.x() * size.x(), corner.y() + (1 - share.y()) * size.y()};
}

double nice_step(double range, double count) {
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

std::vector<double> ticks(double low, double high, double step) {
  constexpr double kRounding = 1e-9;  // of a step
  std::vector<double> result;
  for (double k = std::ceil(low / step - kRounding); k <= high / step + kRounding; ++k)
    result.push_back(k * step + 0.0);  // no -0
  return result;
}

void draw_axes(const Axes& axes, const AxesLabels& labels, SvgCanvas& canvas) {
  const SvgStyle grid{kGrid, "none", 1};
  const double left = axes.corner.x(), top = axes.corner.y();
  const double right = left + axes.size.x(), bottom = top + axes.size.y();
  for (const double value : ticks(axes.low.x(), axes.high.x(), labels.step.x())) {
    const double at = axes({value, axes.low.y()}).x();
    canvas.line({at, top}, {at, bottom}, grid);
    if (!labels.numbers_across) continue;
    canvas.text({at, bottom + 18}, fmt::format("{:.{}f}", value, decimals_of(labels.step.x())),
                {.size = 12, .fill = kSoftInk, .anchor = SvgAnchor::middle});
  }
  for (const double value : ticks(axes.low.y(), axes.high.y(), labels.step.y())) {
    const double at = axes({axes.low.x(), value}).y();
    canvas.line({left, at}, {right, at}, grid);
    if (!labels.numbers_up) continue;
    canvas.text({left - 9, at + 4}, fmt::format("{:.{}f}", value, decimals_of(labels.step.y())),
                {.size = 12, .fill = kSoftInk, .anchor = SvgAnchor::end});
  }
  canvas.rectangle(axes.corner, axes.size, {kFrame, "none", 1});
  const SvgText name{.fill = kInk, .anchor = SvgAnchor::middle};
  if (!labels.across.empty()) canvas.text({left + 0.5 * axes.size.x(), bottom + 40}, labels.across, name);
  if (!labels.up.empty()) {
    SvgText turned = name;
    turned.turned_deg = 90;
    canvas.text({left - 54, top + 0.5 * axes.size.y()}, labels.up, turned);
  }
}

}  // namespace cairn
