// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/observe.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cairn {
namespace {

/// Metres at the nearest pixel; 0 where unknown, out of range, or at a jump of depth: a corner on an outline
/// belongs to one side, its depth may come from the other, and the inliers among these shorten the motion by
/// 1 to 2 %.
double depth_at(const DepthImage& depth, const Keypoint& keypoint, const Rig& rig, const DepthNoise& noise) {
  const int u = static_cast<int>(std::lround(keypoint.u)), v = static_cast<int>(std::lround(keypoint.v));
  if (!depth.contains(u, v)) return 0;
  const auto z = static_cast<double>(depth(u, v));
  if (!(z >= noise.min_depth && z <= noise.max_depth)) return 0;
  const int radius =
      static_cast<int>(std::lround(noise.jump_radius * static_cast<double>(keypoint.sigma_px)));
  const double jump = noise.jump_sigmas * noise.sigma_disparity_px;
  for (int y = std::max(0, v - radius); y <= std::min(depth.height() - 1, v + radius); ++y) {
    for (int x = std::max(0, u - radius); x <= std::min(depth.width() - 1, u + radius); ++x) {
      const auto other = static_cast<double>(depth(x, y));
      if (other > 0 && std::abs(rig.disparity(other) - rig.disparity(z)) > jump) return 0;
    }
  }
  return z;
}

Observation make_observation(const Rig& rig, const Eigen::Vector2d& ray, const Keypoint& keypoint,
                             double depth, const DepthNoise& noise) {
  Observation seen;
  seen.u = rig.fx * ray.x() + rig.cx;
  seen.v = rig.fy * ray.y() + rig.cy;
  seen.sigma_px = static_cast<double>(keypoint.sigma_px);
  seen.sigma_d_px = noise.sigma_disparity_px;
  if (depth > 0) seen.d = rig.disparity(depth);
  return seen;
}

Descriptors select(const Descriptors& all, const std::vector<std::size_t>& kept) {
  Descriptors some(all.norm(), all.bytes(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) std::memcpy(some.row(i), all.row(kept[i]), all.stride());
  return some;
}

}  // namespace

Rig rgbd_rig(const Camera& camera, const DepthNoise& noise) {
  return {camera.fx, camera.fy, camera.cx, camera.cy, noise.baseline};
}

ObservedFrame observe(const Frame& frame, const Camera& camera, const Extractor& extractor,
                      const DepthNoise& noise) {
  const Rig rig = rgbd_rig(camera, noise);
  const Features all = extractor.extract(frame.gray);
  ObservedFrame observed{frame.id, frame.stamp_ns, {}, {}, {}};
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.keypoints.size(); ++i) {
    const Keypoint& keypoint = all.keypoints[i];
    const auto ray = camera.unproject({static_cast<double>(keypoint.u), static_cast<double>(keypoint.v)});
    if (!ray) continue;
    const double depth = depth_at(frame.depth, keypoint, rig, noise);
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    kept.push_back(i);
    observed.features.keypoints.push_back(keypoint);
    const Observation seen = make_observation(rig, *ray, keypoint, depth, noise);
    observed.observations.push_back(seen);
    observed.points_in_camera.push_back(depth > 0 ? rig.point_at(seen.u, seen.v, depth) : none);
  }
  observed.features.descriptors = select(all.descriptors, kept);
  return observed;
}

}  // namespace cairn
