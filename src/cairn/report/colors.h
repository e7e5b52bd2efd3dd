// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "cairn/image/image.h"

namespace cairn {

inline const std::string kInk = "#1e293b", kSoftInk = "#64748b", kGrid = "#e9edf2", kFrame = "#cbd5e1",
                         kReference = "#b6c0cd";

/// For a value as a share of the largest, 0 to 1: dark blue over red to orange.
[[nodiscard]] Rgb8 error_rgb(double share);
/// The ends of the scale of a landmark's standard deviation, metres; it is logarithmic.
constexpr double kLowStd = 0.01, kHighStd = 1.0;
constexpr Rgb8 kUnknownStd{150, 150, 150};
/// Returns where a standard deviation (metres) lies on that scale, 0 to 1.
[[nodiscard]] double std_share(double std);
/// Returns the colour for it; grey for NaN, which is not known.
[[nodiscard]] Rgb8 std_rgb(double std);
/// The same as error_rgb, as SVG has it.
[[nodiscard]] std::string error_color(double share);
/// Of one of several lines in a picture; told apart by the colour-blind, too. They repeat after the seventh.
[[nodiscard]] std::string line_color(std::size_t line);

}  // namespace cairn
