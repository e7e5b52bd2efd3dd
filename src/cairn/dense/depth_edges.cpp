// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/depth_edges.h"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kReach = 2;  // pixels: the blur of depth and registration

bool is_edge(float a, float b, float max_step) {
  return a > 0 && b > 0 && std::abs(a - b) > max_step * std::min(a, b);
}

}  // namespace

DepthImage without_depth_edges(const DepthImage& depth, double max_step) {
  const auto step = static_cast<float>(max_step);
  DepthImage kept = depth;
  for (int v = 0; v < depth.height(); ++v) {
    const float* row = depth.row(v);
    const float* above = depth.row(std::max(0, v - kReach));
    const float* below = depth.row(std::min(depth.height() - 1, v + kReach));
    float* out = kept.row(v);
    for (int u = 0; u < depth.width(); ++u)
      out[u] = is_edge(row[u], above[u], step) || is_edge(row[u], below[u], step) ? 0.0F : row[u];
    for (int u = kReach; u < depth.width(); ++u)
      if (is_edge(row[u], row[u - kReach], step)) out[u] = out[u - kReach] = 0.0F;
  }
  return kept;
}

}  // namespace cairn
