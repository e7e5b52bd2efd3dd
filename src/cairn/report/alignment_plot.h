// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace cairn {

/// Two paths before and after one is moved onto the other; metres.
struct AlignmentPlot {
  std::string title, subtitle;  ///< one line each
  std::string before, after;    ///< what is written over each half
  std::vector<Eigen::Vector3d> reference;
  std::vector<Eigen::Vector3d> estimate_before, estimate_after;
};

/// An SVG file: left before, right after, each to a scale of its own, along the axis of the world in which
/// the reference spreads least.
[[nodiscard]] std::string draw_alignment_plot(const AlignmentPlot& plot);

}  // namespace cairn
