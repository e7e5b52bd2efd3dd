// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/observed_frame.h"

#include <algorithm>
#include <limits>

namespace cairn {

double median_depth(const ObservedFrame& frame) {
  std::vector<double> depths;
  for (const Eigen::Vector3d& point : frame.points_in_camera)
    if (point.allFinite()) depths.push_back(point.z());
  if (depths.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

}  // namespace cairn
