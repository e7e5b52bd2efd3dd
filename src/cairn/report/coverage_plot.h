// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/evaluate/consistency.h"

namespace cairn {

/// Holds what is drawn: whether stated covariances are honest.
struct CoveragePlot {
  struct Curve {
    std::string name;
    ConsistencyReport report;
  };
  struct Panel {
    std::string title;
    std::vector<Curve> curves;  ///< at least one
  };

  std::string title;     ///< one line
  std::string subtitle;  ///< one line, smaller
  std::vector<Panel> panels;
};

/// Draws an SVG file: in each panel, against the nominal share of a confidence ellipsoid, the share of errors
/// that were observed inside. Honest covariances follow the diagonal; below it lie those that promise too
/// much, above it those that promise too little. The band around the diagonal holds 95 % of the observed
/// shares of honest covariances if the errors of the first curve are independent. There is a panel at least.
[[nodiscard]] std::string draw_coverage_plot(const CoveragePlot& plot);

}  // namespace cairn
