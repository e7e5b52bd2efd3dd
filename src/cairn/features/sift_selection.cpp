// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/sift_selection.h"

#include <algorithm>

namespace cairn {

std::vector<ScalePoint> select_spread(const ScaleSpace& space, std::vector<ScalePoint> points, int count) {
  static_cast<void>(space);
  points.resize(std::min(points.size(), static_cast<std::size_t>(count)));
  return points;
}

}  // namespace cairn
