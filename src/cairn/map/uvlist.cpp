// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/uvlist.h"

#include <fmt/format.h>

namespace cairn {

std::string uvlist_header() {
  std::string header = "# id x y z frames std_x std_y std_z rms_px";
  for (const char* quantity : {"distance", "lateral", "depth", "angle_deg"})
    for (const char* statistic : {"mean", "min", "max", "std"})
      header += fmt::format(" {}_{}", statistic, quantity);
  return header + "\n";
}

std::string format_uvlist_row(std::uint32_t number, const Eigen::Vector3d& point_in_world,
                              const Eigen::Matrix3d& covariance, const LandmarkIndicators& indicators) {
  const Eigen::Vector3d std = covariance.diagonal().cwiseSqrt();
  std::string row = fmt::format("{} {} {} {} {} {:.6g} {:.6g} {:.6g} {:.6g}", number, point_in_world.x(),
                                point_in_world.y(), point_in_world.z(), indicators.frames, std.x(), std.y(),
                                std.z(), indicators.rms_px);
  for (const Spread& spread :
       {indicators.distance, indicators.lateral, indicators.depth, indicators.angle_deg})
    row += fmt::format(" {:.6g} {:.6g} {:.6g} {:.6g}", spread.mean, spread.min, spread.max, spread.std);
  return row + "\n";
}

}  // namespace cairn
