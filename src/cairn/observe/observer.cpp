// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/observer.h"

#include <algorithm>
#include <cmath>

#include "cairn/matching/stereo_matching.h"

namespace cairn {
namespace {

/// Returns the depth at the nearest pixel, metres; 0 if unknown, out of range, or at a jump of the depth: a
/// corner on an outline belongs to one side, its depth may come from the other, and the inliers among these
/// shorten the motion by 1 to 2 %.
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

/// Returns a frame without features.
ObservedFrame begin_frame(const Frame& frame) {
  return {frame.id, frame.stamp_ns, {}, {}, {}};
}

void add(const Rig& rig, const Observation& seen, const Keypoint& keypoint, ObservedFrame& observed) {
  observed.features.keypoints.push_back(keypoint);
  observed.features.keypoints.back().u = static_cast<float>(seen.u);
  observed.features.keypoints.back().v = static_cast<float>(seen.v);
  observed.observations.push_back(seen);
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  observed.points_in_camera.push_back(seen.has_disparity() ? rig.point_at(seen.u, seen.v, rig.depth(seen.d))
                                                           : none);
}

}  // namespace

Rig rig_of(const Calibration& calibration, const DepthNoise& noise) {
  const Camera& camera = calibration.camera;
  return {camera.fx, camera.fy, camera.cx, camera.cy, calibration.baseline.value_or(noise.baseline)};
}

Observer::Observer(const Calibration& calibration, const ObserverOptions& options)
    : camera_(calibration.camera),
      rig_(rig_of(calibration, options.depth_noise)),
      depth_(options.depth_noise),
      stereo_(options.stereo_noise),
      correction_(calibration.right_correction.value_or(StereoCorrection{})),
      extractor_(make_extractor(options.features)) {}

ObservedFrame Observer::observe(const Frame& frame) const {
  return frame.right.empty() ? observe_rgbd(frame) : observe_stereo(frame);
}

ObservedFrame Observer::observe_rgbd(const Frame& frame) const {
  const Features all = extractor_->extract(frame.gray);
  ObservedFrame observed = begin_frame(frame);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.keypoints.size(); ++i) {
    const Keypoint& keypoint = all.keypoints[i];
    const auto ray = camera_.unproject({static_cast<double>(keypoint.u), static_cast<double>(keypoint.v)});
    if (!ray) continue;
    const double depth = depth_at(frame.depth, keypoint, rig_, depth_);
    kept.push_back(i);
    add(rig_, make_observation(rig_, *ray, keypoint, depth, depth_), keypoint, observed);
  }
  observed.features.descriptors = select(all.descriptors, kept);
  return observed;
}

ObservedFrame Observer::observe_stereo(const Frame& frame) const {
  Features left = extractor_->extract(frame.gray);
  const Features right = extractor_->extract(frame.right);
  StereoMatchOptions matching;
  matching.min_depth = stereo_.min_depth;
  matching.min_correlation = stereo_.min_correlation;
  matching.search_images = stereo_.search_images;
  const auto matches = match_stereo(rig_, {left, frame.gray}, {right, frame.right}, matching);
  ObservedFrame observed = begin_frame(frame);
  for (std::size_t i = 0; i < left.keypoints.size(); ++i) {
    const Keypoint& keypoint = left.keypoints[i];
    Observation seen{static_cast<double>(keypoint.u), static_cast<double>(keypoint.v)};
    seen.sigma_px = static_cast<double>(keypoint.sigma_px);
    if (matches[i] && matches[i]->measured) {
      const double sigma = std::hypot(matches[i]->sigma_disparity_px, stereo_.sigma_floor_px);
      const double disparity = correction_.corrected(rig_, seen.u, matches[i]->disparity);
      if (disparity > stereo_.min_disparity_sigmas * sigma) {
        seen.d = disparity;
        seen.sigma_d_px = sigma;
      }
    }
    add(rig_, seen, keypoint, observed);
  }
  observed.features.descriptors = std::move(left.descriptors);
  return observed;
}

}  // namespace cairn
