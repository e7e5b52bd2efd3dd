// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {

/// The plasma colour map (van der Walt and Smith 2015) up to 85 %: its yellow end is lost on white.
Rgb8 error_rgb(double share) {
  constexpr std::array<std::array<double, 3>, 6> kStops = {
      {{13, 8, 135}, {91, 1, 165}, {154, 23, 155}, {203, 70, 121}, {235, 120, 82}, {251, 178, 47}}};
  const double position = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const double part = position - static_cast<double>(stop);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(std::lround((1 - part) * kStops[stop][c] + part * kStops[stop + 1][c]));
  };
  return {channel(0), channel(1), channel(2)};
}

double std_share(double std) {
  return std::clamp(std::log(std::max(std, kLowStd) / kLowStd) / std::log(kHighStd / kLowStd), 0.0, 1.0);
}

Rgb8 std_rgb(double std) {
  return std::isnan(std) ? kUnknownStd : error_rgb(std_share(std));
}

std::string error_color(double share) {
  const Rgb8 color = error_rgb(share);
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

/// Okabe and Ito 2008, "Color universal design", without black and yellow.
std::string line_color(std::size_t line) {
  constexpr std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#56b4e9", "#e69f00", "#6b4c9a"};
  return kColors[line % kColors.size()];
}

}  // namespace cairn
