// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace cairn {

/// What is drawn; places in metres, in one world.
struct TrajectoryPlot {
  struct Pose {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double error_m = 0;
    bool connected = true;  ///< drawn with a line from the pose before; false where poses are missing
  };

  std::string title;     ///< one line
  std::string subtitle;  ///< one line, smaller
  std::vector<Eigen::Vector3d> reference;
  std::vector<Pose> estimate;
};

/// An SVG file: reference and estimate seen along the axis with the smallest spread, both axes to one scale,
/// with a grid in metres, the estimate coloured by its error and a legend.
[[nodiscard]] std::string draw_trajectory_plot(const TrajectoryPlot& plot);

}  // namespace cairn
