// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace cairn {

/// What is drawn; places in metres, in one world.
struct TrajectoryPlot {
  struct Pose {
    double time_s = 0;  ///< since a time that all estimates share
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double error_m = 0, error_deg = 0;
    bool connected = true;  ///< drawn with a line from the pose before; false where poses are missing
  };
  struct Estimate {
    std::string name;
    std::vector<Pose> poses;
  };

  std::string title;     ///< one line
  std::string subtitle;  ///< one line, smaller
  std::vector<Eigen::Vector3d> reference;
  std::vector<Estimate> estimates;
};

/// An SVG file. Above, reference and estimates from three sides (xy, xz, yz), all axes to one scale; one
/// estimate is coloured by its error, several by a colour each. Below, the errors of translation and rotation
/// over time.
[[nodiscard]] std::string draw_trajectory_plot(const TrajectoryPlot& plot);

}  // namespace cairn
